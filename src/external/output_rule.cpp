/// Numbers from what a program has written: a column found by its name, or a POSIX
/// regular expression line by line; then one of them, or their sum or mean.
/// Source: POSIX regcomp (`grep -E`). Left out: times, units, binary files, decimal
/// commas, matches over several lines.
#include "external/output_rule.hpp"

#include "base/byte_order_mark.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <regex.h>

namespace bemcal::external {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::string_view blanks = " \t\r";
/// What a pattern is sought in of one line: a failing one may take the square of it.
constexpr std::size_t longest_line = 4000;

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::optional<double> number_of(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty())
        return std::nullopt;
    return value;
}

std::string shortened(std::string_view text) {
    return text.size() > 60 ? std::string(text.substr(0, 57)) + "..." : std::string(text);
}

Words lines_of(std::string_view text) {
    Words lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// Of a file that is one column, whose name may hold blanks.
constexpr char no_separator = '\n';

/// A blank stands for runs of blanks and tabs.
char separator_of(std::string_view header) {
    char best = ' ';
    std::ptrdiff_t most = 0;
    for (const char c : {',', ';', '\t'})
        if (const auto n = std::ranges::count(header, c); n > most) {
            best = c;
            most = n;
        }
    return best;
}

/// The end of a cell that begins here; a quoted one may hold separators.
std::size_t cell_end(std::string_view line, char separator) {
    const std::size_t quoted = line.starts_with('"') ? line.find('"', 1) : 0;
    const std::size_t from = quoted == std::string_view::npos ? 0 : quoted;
    const std::size_t end =
        separator == ' ' ? line.find_first_of(blanks, from) : line.find(separator, from);
    return std::min(end, line.size());
}

Words cells_of(std::string_view line, char separator) {
    Words cells;
    if (separator == ' ') line = trimmed(line);
    while (true) {
        const std::size_t end = cell_end(line, separator);
        std::string_view cell = trimmed(line.substr(0, end));
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
            cell = trimmed(cell.substr(1, cell.size() - 2));
        cells.push_back(cell);
        if (end == line.size()) return cells;
        line.remove_prefix(end + 1);
        if (separator == ' ') line = trimmed(line);
    }
}

Readings failed(const OutputRule& rule, const std::string& why) {
    return {{}, fmt::format("{}: {}", rule.file, why)};
}

Readings in_column(const OutputRule& rule, const std::string& text) {
    const Words lines = lines_of(text);
    const auto header = static_cast<std::size_t>(rule.header_line);
    if (lines.size() < header)
        return failed(rule, fmt::format("has no line {} with the names of columns",
                                        rule.header_line));
    const std::string_view head = without_byte_order_mark(lines[header - 1]);
    const char separator =
        trimmed(head) == rule.column ? no_separator : separator_of(head);
    const Words names = cells_of(head, separator);
    if (std::ranges::count(names, std::string_view(rule.column)) > 1)
        return failed(rule, fmt::format("has several columns \"{}\"", rule.column));
    const auto column = static_cast<std::size_t>(
        std::ranges::find(names, std::string_view(rule.column)) - names.begin());
    if (column == names.size())
        return failed(rule,
                      fmt::format("has no column \"{}\", but {}", rule.column,
                                  shortened(fmt::format("{}", fmt::join(names, ", ")))));
    Readings found;
    for (std::size_t k = header + static_cast<std::size_t>(rule.skipped);
         k < lines.size(); ++k) {
        const Words cells = cells_of(lines[k], separator);
        if (column >= cells.size() || cells[column].empty()) continue;
        const auto value = number_of(cells[column]);
        if (!value)
            return failed(rule,
                          fmt::format("line {} of the column \"{}\": \"{}\" is no "
                                      "number",
                                      k + 1, rule.column, shortened(cells[column])));
        found.values.push_back(*value);
    }
    return found;
}

/// A compiled regular expression.
class Pattern {
  public:
    explicit Pattern(const std::string& text) {
        const int error = ::regcomp(&compiled_, text.c_str(), REG_EXTENDED);
        if (error == 0) return;
        char reason[200];
        ::regerror(error, &compiled_, reason, sizeof reason);
        throw std::invalid_argument(
            fmt::format("\"{}\" is no regular expression: {}", text, reason));
    }
    ~Pattern() { ::regfree(&compiled_); }
    Pattern(const Pattern&) = delete;
    Pattern& operator=(const Pattern&) = delete;

    std::size_t n_groups() const { return compiled_.re_nsub; }
    /// Adds what the first group finds, for every match in the line.
    void find_in(const std::string& line, std::vector<std::string>& words) const {
        regmatch_t match[2];
        std::size_t at = 0;
        while (at <= line.size() && ::regexec(&compiled_, line.c_str() + at, 2, match,
                                              at == 0 ? 0 : REG_NOTBOL) == 0) {
            words.emplace_back();
            if (match[1].rm_so >= 0)
                words.back() = line.substr(
                    at + static_cast<std::size_t>(match[1].rm_so),
                    static_cast<std::size_t>(match[1].rm_eo - match[1].rm_so));
            at += static_cast<std::size_t>(std::max(match[0].rm_eo, match[0].rm_so + 1));
        }
    }

  private:
    regex_t compiled_{};
};

Readings by_pattern(const OutputRule& rule, const std::string& text) {
    const Pattern pattern(rule.pattern);
    std::vector<std::string> words;
    for (std::string_view line : lines_of(text)) {
        if (line.ends_with('\r')) line.remove_suffix(1);
        pattern.find_in(std::string(line.substr(0, longest_line)), words);
    }
    Readings found;
    found.values.reserve(words.size());
    for (const std::string& word : words) {
        const auto value = number_of(word);
        if (!value)
            return failed(rule, fmt::format("\"{}\" finds \"{}\", which is no number",
                                            rule.pattern, shortened(word)));
        found.values.push_back(*value);
    }
    return found;
}

std::string what_of(const OutputRule& rule) {
    return rule.column.empty() ? fmt::format("\"{}\" finds", rule.pattern)
                               : fmt::format("the column \"{}\" has", rule.column);
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// An order has no place for it.
std::optional<double> first_nan(const std::vector<double>& values) {
    const auto found = std::ranges::find_if(values, [](double v) { return v != v; });
    return found == values.end() ? std::nullopt : std::optional(*found);
}

double taken(const OutputRule& rule, const std::vector<double>& values) {
    switch (rule.take) {
        case Take::only:
        case Take::first:
            return values.front();
        case Take::last:
            return values.back();
        case Take::sum:
            return sum_of(values);
        case Take::mean:
            return sum_of(values) / static_cast<double>(values.size());
        case Take::least:
            return first_nan(values).value_or(*std::ranges::min_element(values));
        case Take::most:
            return first_nan(values).value_or(*std::ranges::max_element(values));
        case Take::row:
            return values[static_cast<std::size_t>(rule.row - 1)];
    }
    return values.front();
}

Reading reduce(const OutputRule& rule, const Readings& found) {
    if (!found.failure.empty()) return {0, found.failure};
    const std::size_t n = found.values.size();
    const auto fail = [&](const std::string& why) {
        return Reading{0, fmt::format("{}: {} {}", rule.file, what_of(rule), why)};
    };
    if (n == 0) return fail("no number");
    if (rule.rows > 0 && n != static_cast<std::size_t>(rule.rows))
        return fail(fmt::format("{} numbers, but rows = {}", n, rule.rows));
    if (rule.take == Take::only && n > 1)
        return fail(fmt::format("{} numbers, not one: say which to take", n));
    if (rule.take == Take::row && n < static_cast<std::size_t>(rule.row))
        return fail(fmt::format("{} numbers, but row = {}", n, rule.row));
    const double value = rule.factor * taken(rule, found.values) + rule.offset;
    if (!std::isfinite(value)) return fail(fmt::format("{}, not a finite number", value));
    return {value, {}};
}

}  // namespace

void check_pattern(const std::string& pattern) {
    if (Pattern(pattern).n_groups() == 0)
        throw std::invalid_argument(
            fmt::format("\"{}\" has no group; expected the number in parentheses, like "
                        "\"heating: ([0-9.]+)\"",
                        pattern));
}

const FileText& WrittenFiles::text(const std::string& file) {
    const auto [known, is_new] = texts_.try_emplace(file);
    if (is_new) {
        known->second = text_of_file(folder_ / file, most_bytes_);
        std::ranges::replace(known->second.text, '\0', ' ');
    }
    return known->second;
}

Reading WrittenFiles::read(const OutputRule& rule) {
    const FileText& written = text(rule.file);
    if (!written.failure.empty())
        return {0, fmt::format("{}: {}", rule.file, written.failure)};
    return reduce(rule, rule.column.empty() ? by_pattern(rule, written.text)
                                            : in_column(rule, written.text));
}

Readings WrittenFiles::read_all(const OutputRule& rule) {
    const FileText& written = text(rule.file);
    if (!written.failure.empty())
        return {{}, fmt::format("{}: {}", rule.file, written.failure)};
    Readings found = in_column(rule, written.text);
    for (double& value : found.values) {
        value = rule.factor * value + rule.offset;
        if (!std::isfinite(value))
            return {{},
                    fmt::format("{}: the column \"{}\" has {}, not a finite number",
                                rule.file, rule.column, value)};
    }
    return found;
}

}  // namespace bemcal::external
