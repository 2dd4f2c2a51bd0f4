/// Reads one EPW file line by line: the place, the dates in sequence, eight columns. Any
/// bytes may come in; each field is checked before it is used.
/// Source: EnergyPlus Auxiliary Programs, EPW Data Dictionary.
/// Leaves out other header lines, sub-hourly files and several data periods. Gaps stay
/// NaN, for `epw` to fill, but a missing 29 February repeats the 28th.
#include "input/epw_table.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace bemcal::input {

using physics::Weather;

const std::array<EpwColumn, n_epw_columns> epw_columns{{
    {7, "dry bulb temperature", "degC", -70, 70, 99.9, true, 1, &Weather::theta_e},
    {9, "relative humidity", "%", 0, 110, 999, false, 1, &Weather::relative_humidity},
    {13, "infrared from the sky", "W/m2", 0, 1000, 9999, false, 1, &Weather::infrared},
    {14, "global horizontal irradiance", "W/m2", -20, 2000, 9999, true, 1,
     &Weather::global_horizontal},
    {15, "direct normal irradiance", "W/m2", -20, 2000, 9999, true, 1,
     &Weather::direct_normal},
    {16, "diffuse horizontal irradiance", "W/m2", -20, 2000, 9999, true, 1,
     &Weather::diffuse_horizontal},
    {22, "wind speed", "m/s", 0, 100, 999, false, 1, &Weather::wind_speed},
    {23, "total sky cover", "tenths", 0, 10, 99, false, 0.1, &Weather::cloud_cover},
}};

void fail_epw(const std::string& name, int line, int field, const std::string& message) {
    throw UserError(ExitCode::data,
                    fmt::format("{}:{}:{}: {}", name, line, field, message));
}

namespace {

using physics::Seconds;
using std::chrono::hours;

constexpr int n_fields = 35;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One line of the file, split at its commas.
struct Line {
    int number = 0;  // from 1
    std::string_view text;
    std::array<std::string_view, n_fields> fields{};
    int count = 0;  // of fields; those beyond n_fields are ignored
    std::string_view field(int from_one) const {
        return from_one <= count ? fields[static_cast<std::size_t>(from_one - 1)] : "";
    }
};

std::string_view trim(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const std::size_t first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// What a message shows of the file: short, and printable.
std::string shown(std::string_view text) {
    std::string result(text.substr(0, 30));
    for (char& c : result)
        if (c < ' ' || c > '~') c = '?';
    return result;
}

/// Hands out the lines of a text one by one.
class Lines {
  public:
    explicit Lines(std::string_view text) : rest_(text) {
        if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    }
    int number() const { return number_; }
    std::optional<Line> next() {
        if (rest_.empty()) return std::nullopt;
        const std::size_t end = rest_.find('\n');
        const Line line = split(trim(rest_.substr(0, end)), ++number_);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        return line;
    }

  private:
    static Line split(std::string_view text, int number) {
        Line line{number, text, {}, 0};
        while (line.count < n_fields) {
            const std::size_t comma = text.find(',');
            line.fields[static_cast<std::size_t>(line.count++)] =
                trim(text.substr(0, comma));
            if (comma == std::string_view::npos) break;
            text.remove_prefix(comma + 1);
        }
        return line;
    }
    std::string_view rest_;
    int number_ = 0;
};

template <class Number>
std::optional<Number> to_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>)
        if (!std::isfinite(value)) return std::nullopt;
    return value;
}

/// A number of a line within a range; what it is called is for the message.
template <class Number>
Number number_in(const std::string& name, const Line& line, int field, const char* what,
                 Number least, Number most) {
    const std::optional<Number> value = to_number<Number>(line.field(field));
    if (!value || *value < least || *value > most)
        fail_epw(name, line.number, field,
                 fmt::format("{} = '{}': expected a number from {} to {}", what,
                             shown(line.field(field)), least, most));
    return *value;
}

class TableReader {
  public:
    TableReader(std::string_view text, std::string name, int year)
        : lines_(text), year_(year) {
        table_.name = std::move(name);
    }
    EpwTable read();

  private:
    void read_location(const Line& line);
    void check_data_periods(const Line& line) const;
    void skip_to_data();
    void read_row(const Line& line);
    void start_at(const Line& line, int month, int day, int hour);
    void check_follows(const Line& line, int month, int day, int hour);
    void repeat_28_february(const Line& line);
    void append_values(const Line& line);
    double value_of(const Line& line, std::size_t column);
    void check_length() const;
    void report();

    struct Ignored {
        int n = 0, first_line = 0;
    };
    Lines lines_;
    EpwTable table_;
    int year_;
    bool other_years_ = false;  // rows that name another year than the axis
    int n_negative_ = 0;        // irradiances below 0
    std::array<Ignored, n_epw_columns> ignored_{};
};

EpwTable TableReader::read() {
    skip_to_data();
    while (const std::optional<Line> line = lines_.next())
        if (!line->text.empty()) read_row(*line);
    check_length();
    report();
    return std::move(table_);
}

void TableReader::read_location(const Line& line) {
    const std::string& name = table_.name;
    if (line.field(1) != "LOCATION")
        fail_epw(
            name, line.number, 1,
            fmt::format("'{}': expected 'LOCATION', with which every EPW file begins",
                        shown(line.field(1))));
    physics::Site& site = table_.weather.site;
    site.latitude = number_in(name, line, 7, "latitude [deg]", -90.0, 90.0);
    site.longitude = number_in(name, line, 8, "longitude [deg]", -180.0, 180.0);
    site.utc_offset_h = number_in(name, line, 9, "time zone [h]", -12.0, 14.0);
    site.elevation = number_in(name, line, 10, "elevation [m]", -1000.0, 9000.0);
    table_.place = shown(line.field(2));
}

void TableReader::check_data_periods(const Line& line) const {
    if (number_in(table_.name, line, 2, "number of data periods", 1, 1000) != 1)
        fail_epw(table_.name, line.number, 2,
                 "several data periods: expected 1; write each to a file of its own");
    if (number_in(table_.name, line, 3, "records per hour", 1, 60) != 1)
        fail_epw(table_.name, line.number, 3,
                 "a sub-hourly file: expected 1 record per hour; average the rows of "
                 "each hour");
}

void TableReader::skip_to_data() {
    constexpr int most_header_lines = 100;
    std::optional<Line> line = lines_.next();
    if (!line)
        fail_epw(table_.name, 1, 1, "the file is empty: expected an EPW weather file");
    read_location(*line);
    while ((line = lines_.next()) && line->number <= most_header_lines)
        if (line->field(1) == "DATA PERIODS") return check_data_periods(*line);
    fail_epw(table_.name, lines_.number(), 1,
             "no line 'DATA PERIODS' in the header: expected it as line 8, just before "
             "the hours");
}

void TableReader::read_row(const Line& line) {
    constexpr int least_fields = 16;
    if (line.count < least_fields)
        fail_epw(
            table_.name, line.number, line.count,
            fmt::format("only {} fields: expected 35 (at least {}, up to the diffuse "
                        "irradiance); is the file cut off here?",
                        line.count, least_fields));
    const int year = number_in(table_.name, line, 1, "year", 0, 9999);
    const int month = number_in(table_.name, line, 2, "month", 1, 12);
    const int day = number_in(table_.name, line, 3, "day", 1, 31);
    const int hour = number_in(table_.name, line, 4, "hour (that ends here)", 1, 24);
    if (table_.lines.empty()) start_at(line, month, day, hour);
    check_follows(line, month, day, hour);
    const Seconds begin = table_.weather.axis.end();
    other_years_ |= physics::calendar_step(begin).year != year;
    append_values(line);
}

void TableReader::start_at(const Line& line, int month, int day, int hour) {
    if (year_ == 0) year_ = number_in(table_.name, line, 1, "year", 1800, 2200);
    const auto date = std::chrono::year(year_) / month / day;
    if (!date.ok())
        fail_epw(table_.name, line.number, 3,
                 fmt::format("there is no day {} in month {} of {}", day, month, year_));
    table_.weather.axis = {std::chrono::sys_days(date) + hours(hour - 1), 3600, 0};
}

void TableReader::check_follows(const Line& line, int month, int day, int hour) {
    const auto is_at = [&](Seconds begin) {
        const physics::CalendarStep step = physics::calendar_step(begin);
        return step.month == month && step.day == day && step.hour + 1 == hour;
    };
    const Seconds due = table_.weather.axis.end();
    if (is_at(due)) return;
    const physics::CalendarStep step = physics::calendar_step(due);
    const bool leap_day = step.month == 2 && step.day == 29 && step.hour == 0;
    if (leap_day && is_at(due + hours(24))) return repeat_28_february(line);
    const bool again = is_at(due - hours(1));
    const bool no_leap_day = month == 2 && day == 29;
    fail_epw(
        table_.name, line.number, 2,
        fmt::format(
            "month {}, day {}, hour {}: expected month {}, day {}, hour {} of {}; {}",
            month, day, hour, step.month, step.day, step.hour + 1, step.year,
            again         ? "sub-hourly or repeated rows cannot be read"
            : no_leap_day ? "the year has no 29 February: give a leap year"
                          : "every hour must follow on the one before"));
}

void TableReader::repeat_28_february(const Line& line) {
    if (table_.lines.size() < 24)
        fail_epw(table_.name, line.number, 2,
                 fmt::format(
                     "29 February {} is missing, and so is the day before it: begin the "
                     "file earlier or later",
                     year_));
    for (const EpwColumn& column : epw_columns) {
        std::vector<double>& series = table_.weather.*column.series;
        for (int k = 0; k < 24; ++k) series.push_back(series[series.size() - 24]);
    }
    table_.lines.insert(table_.lines.end(), 24, line.number - 1);
    table_.decisions.push_back(
        fmt::format("{}: no 29 February {}: 28 February repeated", table_.name,
                    physics::calendar_step(table_.weather.axis.end()).year));
    table_.weather.axis.n_steps += 24;
}

void TableReader::append_values(const Line& line) {
    for (std::size_t c = 0; c < epw_columns.size(); ++c)
        (table_.weather.*epw_columns[c].series).push_back(value_of(line, c));
    table_.lines.push_back(line.number);
    ++table_.weather.axis.n_steps;
}

double TableReader::value_of(const Line& line, std::size_t c) {
    const EpwColumn& column = epw_columns[c];
    if (column.field > line.count || line.field(column.field).empty()) return nan;
    const std::optional<double> value = to_number<double>(line.field(column.field));
    if (value && *value >= column.missing) return nan;
    if (value && *value >= column.least && *value <= column.most) {
        const bool negative_irradiance = column.least == -20 && *value < 0;
        n_negative_ += negative_irradiance;
        return negative_irradiance ? 0 : *value * column.scale;
    }
    if (!value || column.needed)
        fail_epw(table_.name, line.number, column.field,
                 fmt::format(
                     "{} = '{}': expected a number from {} to {} {}, or {} where it is "
                     "missing",
                     column.name, shown(line.field(column.field)), column.least,
                     column.most, column.unit, column.missing));
    if (ignored_[c].n++ == 0) ignored_[c].first_line = line.number;
    return nan;
}

void TableReader::check_length() const {
    constexpr int hours_of_year = 8760;
    if (table_.weather.axis.n_steps < hours_of_year)
        fail_epw(
            table_.name, lines_.number(), 1,
            fmt::format("only {} hours: expected a whole year (8760, or 8784 in a leap "
                        "year); is the file cut off here?",
                        table_.weather.axis.n_steps));
}

void TableReader::report() {
    const int year = physics::calendar_step(table_.weather.axis.start).year;
    if (other_years_)
        table_.decisions.push_back(fmt::format(
            "{}: rows of other years (a typical year?) taken as {}", table_.name, year));
    if (n_negative_ > 0)
        table_.decisions.push_back(
            fmt::format("{}: {} irradiances from -20 to 0 W/m2 taken as 0", table_.name,
                        n_negative_));
    for (std::size_t c = 0; c < epw_columns.size(); ++c)
        if (ignored_[c].n > 0)
            table_.decisions.push_back(
                fmt::format("{}:{}:{}: {}: {} values outside {} to {} {} taken as "
                            "missing, the first here",
                            table_.name, ignored_[c].first_line, epw_columns[c].field,
                            epw_columns[c].name, ignored_[c].n, epw_columns[c].least,
                            epw_columns[c].most, epw_columns[c].unit));
}

}  // namespace

EpwTable parse_epw_table(std::string_view text, const std::string& name, int year) {
    return TableReader(text, name, year).read();
}

}  // namespace bemcal::input
