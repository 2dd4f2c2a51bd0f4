/// Reference data that lie beside the project and may be absent, and their CSV tables: a
/// header row or none, no quoted fields.
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

/// A file of the published reference data; a test that needs it is skipped without it.
inline std::filesystem::path shared_file(const std::string& name) {
    return std::filesystem::path(BEMCAL_ROOT) / "../shared/reference" / name;
}

inline bool is_absent(const std::filesystem::path& file) {
    return !std::filesystem::exists(file);
}

enum class Header { present, absent };

class CsvTable {
  public:
    CsvTable() = default;

    /// Throws std::runtime_error where the file cannot be opened.
    explicit CsvTable(const std::filesystem::path& file,
                      Header header = Header::present) {
        std::ifstream stream(file);
        if (!stream) throw std::runtime_error("cannot open " + file.string());
        std::string line;
        if (header == Header::present && std::getline(stream, line)) name_columns(line);
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

    /// The first n fields of a row as numbers. Throws where there are fewer.
    std::vector<double> numbers(std::size_t row, std::size_t n) const {
        std::vector<double> values;
        for (std::size_t k = 0; k < n; ++k)
            values.push_back(std::stod(rows_.at(row).at(k)));
        return values;
    }

  private:
    void name_columns(const std::string& line) {
        for (const std::string& name : split(line))
            columns_.emplace(name, columns_.size());
    }

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
