/// A CSV file with a header row, as the tests' reference tables have it (no quoted
/// fields).
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bemcal::test {

/// Folder of the published reference data, beside the project.
inline std::filesystem::path shared_folder() {
    return std::filesystem::path(BEMCAL_ROOT) / ".." / "shared";
}

class CsvTable {
  public:
    explicit CsvTable(const std::filesystem::path& file) {
        std::ifstream stream(file);
        if (!stream) throw std::runtime_error("cannot open " + file.string());
        std::string line;
        std::getline(stream, line);
        const std::vector<std::string> header = split(line);
        for (std::size_t column = 0; column < header.size(); ++column)
            columns_[header[column]] = column;
        while (std::getline(stream, line))
            if (!line.empty()) rows_.push_back(split(line));
    }

    std::size_t n_rows() const { return rows_.size(); }

    /// An absent field at the end of a row reads as empty.
    std::string text(std::size_t row, const std::string& column) const {
        const std::size_t k = columns_.at(column);
        return k < rows_[row].size() ? rows_[row][k] : std::string();
    }

    double number(std::size_t row, const std::string& column) const {
        return std::strtod(text(row, column).c_str(), nullptr);
    }

  private:
    static std::vector<std::string> split(const std::string& line) {
        std::vector<std::string> fields;
        std::stringstream stream(line.substr(0, line.find('\r')));
        for (std::string field; std::getline(stream, field, ',');)
            fields.push_back(field);
        return fields;
    }

    std::map<std::string, std::size_t> columns_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace bemcal::test
