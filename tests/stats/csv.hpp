/// Reads a comma-separated table as text cells, for tests that compare with reference
/// files.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace bemcal::test {

using Row = std::vector<std::string>;

inline std::filesystem::path sobol_reference(const std::string& file) {
    return std::filesystem::path(BEMCAL_ROOT) / "../shared/reference/sobol" / file;
}

inline std::vector<Row> read_csv(const std::filesystem::path& file) {
    std::vector<Row> rows;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        Row row;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
        rows.push_back(row);
    }
    return rows;
}

}  // namespace bemcal::test
