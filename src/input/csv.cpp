/// Splits a CSV text into lines and cells that point into it; reads numbers on request.
/// Source: RFC 4180, without line breaks in quotes and without doubled quotes.
/// Times are read by `stamps`; gaps are found by `series`.
#include "input/csv.hpp"

#include "base/error.hpp"
#include "input/suggest.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::input {

namespace {

constexpr std::size_t most_columns = 10000;

[[noreturn]] void fail_data(const std::string& message) {
    throw UserError(ExitCode::data, message);
}

std::string_view trimmed(std::string_view cell) {
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t'))
        cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t'))
        cell.remove_suffix(1);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
        cell = cell.substr(1, cell.size() - 2);
    return cell;
}

/// The lines of a text, one after the other.
class Lines {
  public:
    explicit Lines(std::string_view text) : rest_(text) {
        if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    }
    /// The next line that holds something; false at the end.
    bool next(std::string_view& line) {
        while (!rest_.empty()) {
            const std::size_t end = std::min(rest_.find('\n'), rest_.size());
            line = rest_.substr(0, end);
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            ++number_;
            if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
            if (!trimmed(line).empty() && line.front() != '#') return true;
        }
        return false;
    }
    int number() const { return number_; }

  private:
    std::string_view rest_;
    int number_ = 0;
};

char separator_of(std::string_view header) {
    char best = ',';
    auto most = std::count(header.begin(), header.end(), best);
    for (const char candidate : {';', '\t'}) {
        const auto n = std::count(header.begin(), header.end(), candidate);
        if (n <= most) continue;
        best = candidate;
        most = n;
    }
    return best;
}

/// Appends the cells of a line; a separator between quotes is part of its cell.
void split(std::string_view line, char separator, std::vector<std::string_view>& cells) {
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') quoted = !quoted;
        if (i < line.size() && (quoted || line[i] != separator)) continue;
        cells.push_back(trimmed(line.substr(begin, i - begin)));
        begin = i + 1;
    }
}

void check_columns(const Csv& csv, int line) {
    if (csv.columns.size() > most_columns)
        fail_data(
            fmt::format("{}:{}: has more than {} columns", csv.file, line, most_columns));
    std::vector<std::string> sorted = csv.columns;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end() && !twice->empty())
        fail_data(fmt::format("{}:{}: column \"{}\" stands there twice; rename one",
                              csv.file, line, *twice));
}

bool is_missing(std::string_view cell) {
    static constexpr std::string_view words[] = {"",     "NA",   "N/A",  "NaN", "nan",
                                                 "null", "NULL", "None", "-",   "#N/A"};
    return std::find(std::begin(words), std::end(words), cell) != std::end(words);
}

}  // namespace

std::size_t Csv::column(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end())
        fail_data(
            fmt::format("{}:1: has no column \"{}\"; it has {}{}", file, name,
                        fmt::join(columns, ", "),
                        nearest(name, columns).empty() ? "" : suggestion(name, columns)));
    return static_cast<std::size_t>(found - columns.begin());
}

Csv parse_csv(const std::string& text, const std::string& file) {
    Csv csv;
    csv.file = file;
    Lines lines(text);
    std::string_view line;
    if (!lines.next(line))
        fail_data(fmt::format("{}: has no lines; expected a CSV file", file));
    const char separator = separator_of(line);
    std::vector<std::string_view> header;
    split(line, separator, header);
    csv.columns.assign(header.begin(), header.end());
    check_columns(csv, lines.number());
    const auto most_rows =
        static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    csv.cells.reserve(std::min(most_rows * csv.columns.size(), text.size()));
    while (lines.next(line)) {
        const std::size_t before = csv.cells.size();
        split(line, separator, csv.cells);
        if (const std::size_t n = csv.cells.size() - before; n != csv.columns.size())
            fail_data(fmt::format(
                "{}:{}: has {} cell{}; expected {} as in the first line", file,
                lines.number(), n, n == 1 ? "" : "s", csv.columns.size()));
        csv.lines.push_back(lines.number());
    }
    if (csv.lines.empty())
        fail_data(fmt::format("{}: has no rows after its first line", file));
    return csv;
}

double number_in(const Csv& csv, std::size_t row, std::size_t column, char decimal) {
    const std::string_view cell = csv.cell(row, column);
    if (is_missing(cell)) return std::numeric_limits<double>::quiet_NaN();
    std::string changed;
    std::string_view text = cell;
    if (decimal != '.' && cell.find(decimal) != std::string_view::npos) {
        changed = cell;
        std::replace(changed.begin(), changed.end(), decimal, '.');
        text = changed;
    }
    if (text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value))
        return value;
    const bool comma = decimal == '.' && text.find(',') != std::string_view::npos;
    fail_data(
        fmt::format("{}:{}:{}: \"{}\" is not a number{}", csv.file, csv.lines[row],
                    csv.columns[column], cell.substr(0, 40),
                    comma ? "; set decimal = \",\" in the job if that is a decimal comma"
                          : "; leave the cell empty where a value is missing"));
}

std::vector<double> numbers_in(const Csv& csv, std::size_t column, char decimal) {
    std::vector<double> values(csv.n_rows());
    for (std::size_t row = 0; row < values.size(); ++row)
        values[row] = number_in(csv, row, column, decimal);
    return values;
}

}  // namespace bemcal::input
