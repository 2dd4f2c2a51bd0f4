/// Where a number stands in what another program has written: a column of a CSV file, or
/// what a regular expression finds in any text; one of several numbers, or their sum.
#pragma once

#include "external/regular_file.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace bemcal::external {

/// What becomes of the numbers that are found.
enum class Take { only, first, last, sum, mean, least, most, row };

struct OutputRule {
    std::string name, unit;
    std::string file;  ///< in the point's folder
    /// A column by its name in the header. The separator is the comma, semicolon or tab
    /// that the header has most of, else blanks. Empty cells are left out.
    std::string column;
    int header_line = 1;  ///< of the names
    int skipped = 0;      ///< rows below it that are left out: units
    /// In place of a column: a POSIX extended regular expression (as of `grep -E`), whose
    /// first group is the number; it is sought in each line
    /// (in its first 4,000 characters).
    std::string pattern;
    Take take = Take::only;
    int row = 1;   ///< with Take::row: which of the numbers, from 1
    int rows = 0;  ///< how many numbers there have to be; 0 = any
    double factor = 1, offset = 0;
};

/// Throws std::invalid_argument where it is no regular expression with a group.
void check_pattern(const std::string& pattern);

/// A number, or why there is none.
struct Reading {
    double value = 0;
    std::string failure;
};

/// All numbers of a column, or why there are none.
struct Readings {
    std::vector<double> values;
    std::string failure;
};

/// The files that one run has written, each read once.
class WrittenFiles {
  public:
    /// \param most_bytes  a larger file is refused
    explicit WrittenFiles(std::filesystem::path folder, double most_bytes = 1e9)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}
    Reading read(const OutputRule& rule);
    /// Of a rule with a column; `take` has no say.
    Readings read_all(const OutputRule& rule);

  private:
    const FileText& text(const std::string& file);

    std::filesystem::path folder_;
    double most_bytes_;
    std::map<std::string, FileText> texts_;
};

}  // namespace bemcal::external
