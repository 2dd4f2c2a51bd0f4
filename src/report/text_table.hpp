/// Aligned columns of text: words to the left, numbers to the right.
#pragma once

#include <string>
#include <vector>

namespace bemcal::report {

class TextTable {
  public:
    explicit TextTable(std::vector<std::string> header) { add(std::move(header)); }
    void add(std::vector<std::string> row);
    bool is_empty() const { return rows_.size() == 1; }

    /// Indented by two; cells that are wider than `widest` are cut with "..", in
    /// the middle where only their ends tell them apart.
    std::string text(std::size_t widest = 40) const;

  private:
    std::vector<std::vector<std::string>> rows_;
};

/// Lines of at most 98 columns, the first indented by two, the others by four.
std::string wrapped(const std::string& sentence);
/// What was found in data, and what was done about it: a sentence each.
std::string finding_line(const std::string& series, const std::string& finding,
                         const std::string& action);

/// Below a table with a column G14: what is shown divides by n, as all other errors do.
inline constexpr const char* guideline_note =
    "  G14: whether Guideline 14 is met, whose CV(RMSE) and NMBE divide by n - 1\n";

/// A cell of at most that many characters, ended by ".." where it is longer.
std::string cut(const std::string& cell, std::size_t widest);
/// A number for a table: "0.0512", "12.3", "4320", "nan" as "-".
std::string in_short(double value);
/// A share as "12.3 %", NaN as "-".
std::string percent(double share);

}  // namespace bemcal::report
