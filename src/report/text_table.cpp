/// Aligned columns of text: words to the left, numbers to the right, wide cells cut; and
/// how numbers are shown.
/// Plain text without a source. Widths count characters of UTF-8; wide ones count as one.
#include "report/text_table.hpp"

#include "base/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

/// Whether the byte is the first of a character of UTF-8.
bool begins_character(char c) {
    return (c & 0xc0) != 0x80;
}

/// In characters.
std::size_t width_of(const std::string& cell) {
    return static_cast<std::size_t>(std::ranges::count_if(cell, begins_character));
}

/// The first n characters.
std::string beginning_of(const std::string& cell, std::size_t n) {
    const auto end = std::ranges::find_if(
        cell, [&](char c) { return begins_character(c) && n-- == 0; });
    return {cell.begin(), end};
}

/// A column is one of numbers where every cell below the header begins like one.
bool is_number(const std::string& cell) {
    return cell.empty() || cell == "-" || (cell.find_first_of("0123456789") <= 1);
}

/// The last n characters.
std::string end_of(const std::string& cell, std::size_t n) {
    const std::size_t before = width_of(cell) - std::min(n, width_of(cell));
    return cell.substr(beginning_of(cell, before).size());
}

/// Whether cells that differ would look the same.
bool look_alike(const std::vector<std::string>& cells, std::size_t widest) {
    std::map<std::string, std::string> whole;
    return std::ranges::any_of(cells, [&](const std::string& cell) {
        return whole.emplace(cut(cell, widest), cell).first->second != cell;
    });
}

/// Cut at their ends, or, where only these tell them apart, in the middle.
void cut_all(std::vector<std::string>& cells, std::size_t widest) {
    const bool keeps_ends = look_alike(cells, widest);
    for (std::string& cell : cells)
        cell = keeps_ends && width_of(cell) > widest
                   ? cut(cell, widest / 2 + 1) + end_of(cell, widest - widest / 2 - 1)
                   : cut(cell, widest);
}

std::string padded(const std::string& cell, std::size_t width, bool to_right) {
    const std::string gap(width - std::min(width, width_of(cell)), ' ');
    return to_right ? gap + cell : cell + gap;
}

}  // namespace

std::string cut(const std::string& cell, std::size_t widest) {
    return width_of(cell) <= widest ? cell : beginning_of(cell, widest - 2) + "..";
}

/// A cell is one line, whatever a name holds.
void TextTable::add(std::vector<std::string> row) {
    for (std::string& cell : row) cell = in_one_line(cell);
    rows_.push_back(std::move(row));
}

std::string TextTable::text(std::size_t widest) const {
    const std::size_t n_columns = rows_[0].size();
    std::vector<std::vector<std::string>> columns(n_columns);
    std::vector<std::size_t> widths(n_columns, 0);
    std::vector<bool> to_right(n_columns, true);
    for (std::size_t c = 0; c < n_columns; ++c) {
        for (const auto& row : rows_) {
            columns[c].push_back(row[c]);
            if (&row != &rows_[0] && !is_number(row[c])) to_right[c] = false;
        }
        cut_all(columns[c], widest);
        for (const std::string& cell : columns[c])
            widths[c] = std::max(widths[c], width_of(cell));
    }
    std::string out;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        std::string line = " ";
        for (std::size_t c = 0; c < n_columns; ++c)
            line += " " + padded(columns[c][r], widths[c], to_right[c]) +
                    (c + 1 < n_columns ? " " : "");
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    return out;
}

std::string in_short(double value) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    if (size >= 1000 || (size >= 1 && value == std::round(value)))
        return fmt::format("{:.0f}", value);
    return size == 0 || size >= 0.001 ? fmt::format("{:.{}f}", value,
                                                    size >= 10  ? 1
                                                    : size >= 1 ? 2
                                                                : 4)
                                      : fmt::format("{:.2g}", value);
}

std::string percent(double share) {
    return std::isfinite(share) ? fmt::format("{:.1f} %", 100 * share) : "-";
}

std::string wrapped(const std::string& sentence) {
    constexpr std::size_t widest = 98;
    std::istringstream words(sentence);
    std::string text, line = sentence.starts_with("  ") ? "   " : " ";
    for (std::string word; words >> word;) {
        if (line.size() + 1 + word.size() > widest) {
            text += line + "\n";
            line = "     ";
        }
        line += " " + word;
    }
    return text + line + "\n";
}

std::string finding_line(const std::string& series, const std::string& finding,
                         const std::string& action) {
    return wrapped(fmt::format("{}: {}: {}", series, finding, action));
}

}  // namespace bemcal::report
