/// Finds the columns that hold the time, and puts a row's time together from them.
/// Source: ISO 8601, or a form of strptime; names of parts as portals and utilities write
/// them. Of parts that no name tells, the order year, month, day, hour, minute, second.
/// Leaves out days with 23 or 25 columns; clocks are left to `stamps`.
#include "input/time_columns.hpp"

#include "base/error.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::input {

namespace {

using Form = TimeColumns::Form;
using std::chrono::seconds;

constexpr std::size_t looked_at = 50;  ///< rows, to tell what a column is

/// Small letters of a name, without anything else.
std::string letters_of(std::string_view name) {
    std::string letters;
    for (const char c : name) {
        if (c >= 'a' && c <= 'z') letters += c;
        if (c >= 'A' && c <= 'Z') letters += static_cast<char>(c - 'A' + 'a');
    }
    return letters;
}

struct PartName {
    std::string_view name;
    TimePart part;
};
constexpr PartName part_names[] = {{"year", TimePart::year},
                                   {"yyyy", TimePart::year},
                                   {"yr", TimePart::year},
                                   {"jahr", TimePart::year},
                                   {"month", TimePart::month},
                                   {"mo", TimePart::month},
                                   {"mon", TimePart::month},
                                   {"monat", TimePart::month},
                                   {"day", TimePart::day},
                                   {"dy", TimePart::day},
                                   {"dd", TimePart::day},
                                   {"tag", TimePart::day},
                                   {"dayofmonth", TimePart::day},
                                   {"doy", TimePart::day_of_year},
                                   {"dayofyear", TimePart::day_of_year},
                                   {"julianday", TimePart::day_of_year},
                                   {"hour", TimePart::hour},
                                   {"hr", TimePart::hour},
                                   {"hh", TimePart::hour},
                                   {"stunde", TimePart::hour},
                                   {"hourending", TimePart::hour},
                                   {"minute", TimePart::minute},
                                   {"min", TimePart::minute},
                                   {"mi", TimePart::minute},
                                   {"second", TimePart::second},
                                   {"sec", TimePart::second},
                                   {"ss", TimePart::second}};

std::optional<TimePart> part_named(std::string_view name) {
    const std::string letters = letters_of(name);
    for (const PartName& row : part_names)
        if (row.name == letters) return row.part;
    return std::nullopt;
}

bool has(const std::vector<TimePart>& parts, TimePart part) {
    return std::ranges::find(parts, part) != parts.end();
}

/// Year and month, or year and day of the year.
bool are_a_date(const std::vector<TimePart>& parts) {
    return has(parts, TimePart::year) &&
           (has(parts, TimePart::month) || has(parts, TimePart::day_of_year));
}

/// By their names where each name is a part's, each part once; else in their order.
std::vector<TimePart> parts_of(const std::vector<std::string>& names) {
    std::vector<TimePart> parts;
    for (const std::string& name : names)
        if (const auto part = part_named(name); part && !has(parts, *part))
            parts.push_back(*part);
    if (parts.size() == names.size() && are_a_date(parts)) return parts;
    constexpr std::array order = {TimePart::year, TimePart::month,  TimePart::day,
                                  TimePart::hour, TimePart::minute, TimePart::second};
    return {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(
                                               std::min(names.size(), order.size()))};
}

/// A whole number in a cell, "1" or "1.0"; nothing where it is none.
std::optional<int> whole_number(std::string_view cell) {
    double value = 0;
    const auto [end, error] =
        std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
    if (!(std::abs(value) < 1e6) || value != std::floor(value)) return std::nullopt;
    return static_cast<int>(value);
}

/// Hours 1 to 24 with minutes up to 60 are EPW's: the interval that ends then.
bool has_minute_60(const Csv& csv, const TimeColumns& time) {
    for (std::size_t k = 0; k < time.columns.size(); ++k) {
        if (time.parts[k] != TimePart::minute) continue;
        for (std::size_t row = 0; row < csv.n_rows(); ++row)
            if (whole_number(csv.cell(row, time.columns[k])) == 60) return true;
    }
    return false;
}

TimeColumns of_parts(const Csv& csv, std::vector<std::size_t> columns,
                     std::vector<TimePart> parts) {
    TimeColumns time;
    time.form = Form::parts;
    time.columns = std::move(columns);
    time.parts = std::move(parts);
    time.minutes_to_60 = has_minute_60(csv, time);
    return time;
}

TimeColumns of_several(Form form, std::vector<std::size_t> columns) {
    TimeColumns time;
    time.form = form;
    time.columns = std::move(columns);
    return time;
}

TimeColumns named_columns(const Csv& csv, const std::vector<std::string>& names,
                          const std::string& format) {
    std::vector<std::size_t> columns;
    columns.reserve(names.size());
    for (const std::string& name : names) columns.push_back(csv.column(name));
    if (columns.size() == 1) return {columns[0]};
    if (!format.empty() && has_clock(format))
        return of_several(Form::joined, std::move(columns));
    if (columns.size() == 2 && part_named(names[0]) != TimePart::year)
        return of_several(Form::date_and_clock, std::move(columns));
    const std::vector<TimePart> parts = parts_of(names);
    columns.resize(parts.size());
    return of_parts(csv, std::move(columns), parts);
}

/// Year, month, ... in the first columns, by their names.
std::optional<TimeColumns> parts_in_front(const Csv& csv) {
    std::vector<std::size_t> columns;
    std::vector<TimePart> parts;
    for (std::size_t k = 0; k < csv.columns.size(); ++k) {
        const auto part = part_named(csv.columns[k]);
        if (!part || has(parts, *part)) break;
        columns.push_back(k);
        parts.push_back(*part);
    }
    if (!are_a_date(parts)) return std::nullopt;
    return of_parts(csv, std::move(columns), std::move(parts));
}

bool is_named_clock(std::string_view name) {
    const std::string letters = letters_of(name);
    for (const std::string_view word :
         {"time", "hour", "zeit", "stunde", "heure", "hora"})
        if (letters.find(word) != std::string::npos) return true;
    return part_named(name) == TimePart::hour;
}

std::optional<Stamp> stamp_or_none(std::string_view cell, const std::string& format) {
    try {
        return parse_stamp(cell, format);
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

/// Whether the first column has dates without a time, of which two rows are the same.
bool begins_with_dates(const Csv& csv, const std::string& format) {
    if (!format.empty() && has_clock(format)) return false;
    const auto first = stamp_or_none(csv.cell(0, 0), format);
    if (!first || first->face != std::chrono::floor<std::chrono::days>(first->face))
        return false;
    for (std::size_t row = 1; row < std::min(csv.n_rows(), looked_at); ++row)
        if (csv.cell(row, 0) == csv.cell(row - 1, 0)) return true;
    return false;
}

/// Dates that repeat in the first column, and times of day in the second.
std::optional<TimeColumns> clock_in_second(const Csv& csv, const std::string& format) {
    if (csv.columns.size() < 3 || !begins_with_dates(csv, format)) return std::nullopt;
    const bool is_named = is_named_clock(csv.columns[1]);
    for (std::size_t row = 0; row < std::min(csv.n_rows(), looked_at); ++row) {
        const std::string_view cell = csv.cell(row, 1);
        if (!is_named && cell.find(':') == std::string_view::npos) return std::nullopt;
        if (!read_clock(cell)) return std::nullopt;
    }
    return of_several(Form::date_and_clock, {0, 1});
}

[[noreturn]] void fail(const std::string& text, const std::string& expected) {
    throw std::invalid_argument(
        fmt::format("\"{}\" is not a time{}", text.substr(0, 40), expected));
}

Stamp stamp_of_two(std::string_view date, std::string_view clock,
                   const std::string& format) {
    Stamp stamp = parse_stamp(date, format);
    const auto time = read_clock(clock);
    if (!time) fail(std::string(clock), " of day; expected one like 14:00");
    stamp.face += *time;
    stamp.is_24 = *time == std::chrono::hours(24);
    return stamp;
}

/// The numbers of a row by their parts; -1 where there is no such column.
std::array<int, 7> numbers_of(const Csv& csv, std::size_t row, const TimeColumns& time) {
    std::array<int, 7> numbers{-1, 1, 1, -1, 0, 0, 0};
    for (std::size_t k = 0; k < time.columns.size(); ++k) {
        const std::string_view cell = csv.cell(row, time.columns[k]);
        const auto number = whole_number(cell);
        if (!number || *number < 0)
            fail(std::string(cell), fmt::format("'s part; expected a whole number in {}",
                                                csv.columns[time.columns[k]]));
        numbers[static_cast<std::size_t>(time.parts[k])] = *number;
    }
    if (numbers[0] < 100) numbers[0] += numbers[0] < 69 ? 2000 : 1900;
    return numbers;
}

Stamp stamp_of_parts(const Csv& csv, std::size_t row, const TimeColumns& time) {
    const auto [year, month, day, day_of_year, hour, minute, second] =
        numbers_of(csv, row, time);
    const auto text = [&] {
        return fmt::format("{}-{:02}-{:02} {:02}:{:02}", year, month, day, hour, minute);
    };
    using namespace std::chrono;
    year_month_day date{std::chrono::year(year), std::chrono::month(month & 15),
                        std::chrono::day(day & 31)};
    if (day_of_year > 0) date = {std::chrono::year(year) / January / 1};
    const int full = time.minutes_to_60 ? 60 : 59;
    if (!date.ok() || month > 12 || day > 31 || day_of_year > 366 || hour > 24 ||
        minute > full || second > 59 || year < 1800 || year > 2500)
        fail(text(), " of the calendar");
    const int hours = time.minutes_to_60 ? hour - 1 : hour;
    const seconds clock(hours * 3600 + minute * 60 + second);
    if (clock > 24h || clock < 0s) fail(text(), " of a day; expected 00:00 to 24:00");
    return {sys_days(date) + days(std::max(day_of_year - 1, 0)) + clock, std::nullopt,
            clock == 24h};
}

/// The cells with a blank between them.
std::string joined(const Csv& csv, std::size_t row, const TimeColumns& time) {
    std::string text;
    for (const std::size_t column : time.columns) {
        if (!text.empty()) text += ' ';
        text += csv.cell(row, column);
    }
    return text;
}

Stamp stamp_of_row(const Csv& csv, std::size_t row, const TimeColumns& time,
                   const std::string& format) {
    const std::string_view first = csv.cell(row, time.columns[0]);
    if (time.form == Form::parts) return stamp_of_parts(csv, row, time);
    if (time.form == Form::joined) return parse_stamp(joined(csv, row, time), format);
    if (time.form == Form::date_and_clock)
        return stamp_of_two(first, csv.cell(row, time.columns[1]), format);
    return parse_stamp(first, format);
}

/// The time of day that a column's name ends with: "h00", "Hour 1", "00:15", "v0015";
/// in minutes, a bare number as it is.
struct NamedStep {
    int value = -1;
    bool is_clock = false;
};
NamedStep step_named(std::string_view name) {
    if (const std::size_t colon = name.find(':'); colon != std::string_view::npos) {
        const std::size_t begin = name.find_last_not_of("0123456789", colon - 1);
        std::string_view clock =
            name.substr(begin == std::string_view::npos ? 0 : begin + 1);
        clock = clock.substr(0, clock.find_first_not_of("0123456789:"));
        for (const std::string_view text :
             {name.substr(static_cast<std::size_t>(clock.data() - name.data())), clock})
            if (const auto time = read_clock(text))
                return {static_cast<int>(time->count() / 60), true};
        return {};
    }
    const std::size_t last = name.find_last_not_of("0123456789");
    const std::string_view digits =
        name.substr(last == std::string_view::npos ? 0 : last + 1);
    if (digits.empty() || digits.size() > 4) return {};
    int value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return {value, false};
}

/// Minutes since midnight that the k-th of n columns has as 1530, 0015.
int hhmm(int minutes) {
    return minutes / 60 * 100 + minutes % 60;
}

/// Whether n columns from `first` on are named after the steps of a day, in order, by
/// begins (`from` = 0) or ends (1).
bool are_steps(const Csv& csv, std::size_t first, int n, int from) {
    const int minutes = 1440 / n;
    bool counted = true, by_clock = true;
    for (int k = 0; k < n; ++k) {
        const NamedStep step =
            step_named(csv.columns[first + static_cast<std::size_t>(k)]);
        const int at = (k + from) * minutes;
        const bool wraps = step.value == 0 && at == 1440;  // 00:00 for 24:00
        counted = counted && !step.is_clock && step.value == k + from;
        by_clock = by_clock && (wraps || step.value == (step.is_clock ? at : hhmm(at)));
    }
    return counted || by_clock;
}

/// Whether the rows are days, one after the other, by dates without a time.
bool are_days(const Csv& csv, const TimeColumns& time, const std::string& format) {
    std::optional<physics::Seconds> before;
    for (std::size_t row = 0; row < std::min(csv.n_rows(), looked_at); ++row) {
        Stamp stamp;
        try {
            stamp = stamp_of_row(csv, row, time, format);
        } catch (const std::invalid_argument&) {
            return false;
        }
        if (stamp.face != std::chrono::floor<std::chrono::days>(stamp.face)) return false;
        if (before && stamp.face <= *before) return false;
        before = stamp.face;
    }
    return true;
}

/// The number of columns that are a day's steps from `first` on, and whether their names
/// are ends; 0 = they are none.
struct StepColumns {
    int n = 0;
    bool by_ends = false;
};
StepColumns step_columns(const Csv& csv, std::size_t first) {
    for (const int n : {96, 48, 24}) {
        if (first + static_cast<std::size_t>(n) > csv.columns.size()) continue;
        for (const int from : {0, 1})
            if (are_steps(csv, first, n, from)) return {n, from == 1};
    }
    return {};
}

/// A 25th hour of the day on which the clock goes back has no place in a day of 24.
void refuse_longer_days(const Csv& csv, std::size_t next, const StepColumns& steps) {
    if (next >= csv.columns.size()) return;
    const NamedStep step = step_named(csv.columns[next]);
    if (step.is_clock || step.value != steps.n + (steps.by_ends ? 1 : 0)) return;
    for (std::size_t row = 0; row < csv.n_rows(); ++row)
        if (!csv.cell(row, next).empty())
            throw UserError(
                ExitCode::data,
                fmt::format("{}:{}:{}: a day with more than {} readings, of a clock that "
                            "goes back; give each reading a row of its own, with its "
                            "time",
                            csv.file, csv.lines[row], csv.columns[next], steps.n));
}

/// Columns that stay, and one for n of which each line has a row.
Csv rolled_out(const Csv& csv, const std::vector<std::size_t>& kept, std::size_t first,
               std::size_t n) {
    Csv rows;
    rows.file = csv.file;
    rows.header_line = csv.header_line;
    rows.notes = csv.notes;
    rows.unquoted = csv.unquoted;
    for (const std::size_t column : kept) rows.columns.push_back(csv.columns[column]);
    rows.columns.push_back(csv.columns[first]);
    for (std::size_t row = 0; row < csv.n_rows(); ++row)
        for (std::size_t k = 0; k < n; ++k) {
            rows.lines.push_back(csv.lines[row]);
            for (const std::size_t column : kept)
                rows.cells.push_back(csv.cell(row, column));
            rows.cells.push_back(csv.cell(row, first + k));
        }
    return rows;
}

}  // namespace

TimeColumns time_columns(const Csv& csv, const std::vector<std::string>& names,
                         const std::string& format) {
    if (!names.empty()) return named_columns(csv, names, format);
    auto found = parts_in_front(csv);
    if (!found) found = clock_in_second(csv, format);
    if (!found) return {};
    found->found =
        fmt::format("its time stands in the columns {}", names_of(csv, *found));
    return *found;
}

Stamp stamp_in(const Csv& csv, std::size_t row, const TimeColumns& time,
               const std::string& format) {
    Stamp stamp = stamp_of_row(csv, row, time, format);
    if (time.per_day == 0) return stamp;
    const auto n = static_cast<std::size_t>(time.per_day);
    stamp.face += seconds(physics::day_s / time.per_day * static_cast<int>(row % n));
    return stamp;
}

std::string names_of(const Csv& csv, const TimeColumns& time) {
    std::vector<std::string> names;
    names.reserve(time.columns.size());
    for (const std::size_t column : time.columns) names.push_back(csv.columns[column]);
    return fmt::format("{}", fmt::join(names, ", "));
}

std::optional<std::size_t> own_time_of(const Csv& csv, const TimeColumns& time,
                                       std::size_t column, const std::string& format) {
    // The same times by another clock, or of an interval's other end, differ by less.
    constexpr std::chrono::hours most_apart{14}, most_change{2};
    const std::size_t first = time.columns[0], other = column - 1;
    if (time.form != TimeColumns::Form::text || column < first + 3) return std::nullopt;
    std::optional<seconds> apart;
    for (std::size_t row = 0; row < csv.n_rows(); ++row) {
        const auto own = stamp_or_none(csv.cell(row, first), format),
                   its = stamp_or_none(csv.cell(row, other), format);
        if (!its && csv.cell(row, other).empty()) continue;
        if (!own || !its || stamp_or_none(csv.cell(row, first + 1), format))
            return std::nullopt;
        const seconds now = its->face - own->face;
        if (!apart) apart = now;
        if (abs(now) > most_apart || abs(now - *apart) > most_change) return other;
    }
    return std::nullopt;
}

std::optional<Csv> unrolled(const Csv& csv, const std::string& first, TimeColumns& time,
                            const std::string& format, bool by_clock) {
    const auto at = std::ranges::find(csv.columns, first) - csv.columns.begin();
    const auto column = static_cast<std::size_t>(at);
    const StepColumns steps = step_columns(csv, column);
    if (steps.n == 0 || (by_clock && !step_named(first).is_clock) ||
        !are_days(csv, time, format))
        return std::nullopt;
    refuse_longer_days(csv, column + static_cast<std::size_t>(steps.n), steps);
    time.found = fmt::format(
        "it has a day a line, its {} readings in the columns {} to {}", steps.n, first,
        csv.columns[column + static_cast<std::size_t>(steps.n) - 1]);
    Csv rows = rolled_out(csv, time.columns, column, static_cast<std::size_t>(steps.n));
    std::iota(time.columns.begin(), time.columns.end(), 0U);
    time.per_day = steps.n;
    time.by_ends = steps.by_ends;
    return rows;
}

}  // namespace bemcal::input
