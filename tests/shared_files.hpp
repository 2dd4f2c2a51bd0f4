/// Reference files that lie beside the project and may be absent.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::test {

inline std::filesystem::path shared_file(const std::string& name) {
    return std::filesystem::path(BEMCAL_ROOT) / "../shared/reference" / name;
}

inline bool is_absent(const std::filesystem::path& file) {
    return !std::filesystem::exists(file);
}

/// A CSV file of numbers with one line of column names.
struct NumberTable {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;
    std::size_t column(const std::string& name) const {
        for (std::size_t c = 0; c < names.size(); ++c)
            if (names[c] == name) return c;
        throw std::out_of_range(name);
    }
};

inline NumberTable read_numbers(const std::filesystem::path& file) {
    NumberTable table;
    std::ifstream stream(file);
    std::string line, field;
    std::getline(stream, line);
    for (std::istringstream fields(line); std::getline(fields, field, ',');)
        table.names.push_back(field);
    while (std::getline(stream, line)) {
        table.rows.emplace_back();
        for (std::istringstream fields(line); std::getline(fields, field, ',');)
            table.rows.back().push_back(std::stod(field));
    }
    return table;
}

}  // namespace bemcal::test
