/// Reads one EPW file line by line: the place, the dates in sequence, eight columns. Any
/// bytes may come in; each field is checked before it is used.
/// Source: EnergyPlus Auxiliary Programs, EPW Data Dictionary. Quotes and commas in the
/// place are read though it has none.
/// Leaves out other header lines, sub-hourly files and several data periods. Gaps stay
/// NaN, for `epw` to fill, but a missing 29 February repeats the 28th.
#include "input/epw_table.hpp"

#include "base/byte_order_mark.hpp"
#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "base/nan.hpp"
#include "input/data_text.hpp"
#include "input/time_zone.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
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
constexpr double most_absent_share = 0.1;  ///< of the rows; more are of another step

/// One line of the file, split at its commas.
struct Line {
    int number = 0;  // from 1
    std::string_view text;
    std::array<std::string_view, n_fields> fields{};
    int count = 0;  // of fields; those beyond n_fields are ignored
    std::string_view field(int from_one) const {
        return from_one <= count ? fields[static_cast<std::size_t>(from_one - 1)] : "";
    }
    bool is_blank() const {
        return text.find_first_not_of(", \t\"\x1A") == std::string_view::npos;
    }
};

std::string_view without_quotes(std::string_view field) {
    const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
    return quoted ? trimmed(field.substr(1, field.size() - 2)) : field;
}

/// Where the field ends that a text begins with; a comma between quotes is part of it.
std::size_t end_of_field(std::string_view text) {
    std::size_t begin = 0;
    if (trimmed(text).starts_with('"')) begin = text.find('"', text.find('"') + 1);
    return std::min(text.find(',', begin == std::string_view::npos ? 0 : begin),
                    text.size());
}

Line split(std::string_view text, int number) {
    Line line{number, text, {}, 0};
    while (line.count < n_fields) {
        const std::size_t end = end_of_field(text);
        line.fields[static_cast<std::size_t>(line.count++)] =
            without_quotes(trimmed(text.substr(0, end)));
        if (end == text.size()) break;
        text.remove_prefix(end + 1);
    }
    return line;
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
    explicit Lines(std::string_view text) : rest_(without_byte_order_mark(text)) {}
    int number() const { return number_; }
    std::optional<Line> next() {
        std::string_view text;
        if (!next_line(rest_, text)) return std::nullopt;
        return split(trimmed(text), ++number_);
    }

  private:
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
    void check_data_periods(const Line& line);
    void skip_to_data();
    void read_row(const Line& line);
    void start_at(const Line& line, int month, int day, int hour);
    void check_follows(const Line& line, int month, int day, int hour);
    void leave_open(const Line& line, int n, const std::string& what);
    void check_absent();
    void repeat_28_february(const Line& line);
    void append_values(const Line& line);
    double value_of(const Line& line, std::size_t column);
    double outside(const Line& line, std::size_t column, double value);
    void check_length() const;
    void check_codes();
    void report();

    struct Ignored {
        int n = 0, first_line = 0;
        double value = 0;  // of the first
        bool alike = true;
    };
    Lines lines_;
    EpwTable table_;
    int year_;
    bool other_years_ = false;  // rows that name another year than the axis
    int n_negative_ = 0;        // irradiances below 0
    int n_rows_ = 0;
    struct OddRow {
        int line = 0;
        std::string what;
    };
    OddRow odd_row_, first_absent_;  // the last, the first that was not the next hour's
    std::string first_absent_time_;
    int n_absent_ = 0, n_gaps_ = 0;  // hours without a row
    std::string said_end_;           // of the rows, in the header: "12/31"
    std::array<Ignored, n_epw_columns> ignored_{};
};

EpwTable TableReader::read() {
    skip_to_data();
    while (const std::optional<Line> line = lines_.next())
        if (!line->is_blank()) read_row(*line);
    check_length();
    check_absent();
    check_codes();
    report();
    return std::move(table_);
}

constexpr int least_location_fields = 10;

/// The place's fields behind the name, where it holds `commas`; NaN = no number there.
physics::Site site_in(const Line& line, int commas) {
    const auto number = [&](int field) {
        return to_number<double>(line.field(field + commas)).value_or(nan);
    };
    physics::Site site;
    site.latitude = number(7);
    site.longitude = number(8);
    site.utc_offset_h = number(9);
    site.elevation = number(10);
    return site;
}

bool is_possible(const physics::Site& site) {
    return std::abs(site.latitude) <= 90 && std::abs(site.longitude) <= 180 &&
           site.utc_offset_h >= -12 && site.utc_offset_h <= 14 &&
           site.elevation >= -1000 && site.elevation <= 9000 && is_possible_zone(site);
}

int n_filled(const Line& line) {
    int n = line.count;
    while (n > 0 && line.field(n).empty()) --n;
    return n;
}

/// Commas in the name of the place, from where its numbers stand: counted from the right.
int commas_in_place(const std::string& name, const Line& line) {
    const int more = std::max(0, n_filled(line) - least_location_fields);
    const bool at_end = is_possible(site_in(line, more));
    if (more > 0 && at_end && is_possible(site_in(line, 0)))
        fail_epw(name, line.number, 2,
                 "latitude, longitude and time zone can be read at two places; put the "
                 "name of the place into quotes");
    if (at_end) return more;
    for (int commas = 0; commas < more; ++commas)
        if (is_possible(site_in(line, commas))) return commas;
    return 0;
}

void check_zone(const std::string& name, const Line& line, int field,
                const physics::Site& site) {
    if (is_possible_zone(site)) return;
    fail_epw(name, line.number, field,
             fmt::format("time zone [h] = '{}': no place at longitude {} has it, where "
                         "the sun is {:.1f} h from UTC; correct the line (longitudes "
                         "west are negative; a place with a comma needs quotes)",
                         shown(line.field(field)), site.longitude, site.longitude / 15));
}

/// "9/30" of " 9/30", "09/30/2021"; "" of other forms.
std::string month_and_day(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return {};
    const auto month = to_number<int>(trimmed(text.substr(0, slash)));
    text.remove_prefix(slash + 1);
    const auto day = to_number<int>(trimmed(text.substr(0, text.find('/'))));
    return month && day ? fmt::format("{}/{}", *month, *day) : "";
}

bool says_missing(std::string_view field) {
    const std::string word = lower_case(field);
    return word.empty() || word == "nan" || word == "na" || word == "n/a" ||
           word == "null" || word == "none";
}

/// An EPW file has its own code; others are known where all hours hold one.
bool may_be_absent(const EpwColumn& column) {
    return column.least == -20;  // irradiance: the others tell what it is
}

void TableReader::read_location(const Line& line) {
    const std::string& name = table_.name;
    if (lower_case(line.text).starts_with("location;"))
        fail_epw(name, line.number, 1,
                 "semicolons (;) between the fields: expected commas; write the file "
                 "with commas, and points as decimal marks");
    if (lower_case(line.field(1)) != "location")
        fail_epw(
            name, line.number, 1,
            fmt::format("'{}': expected 'LOCATION', with which every EPW file begins; a "
                        "CSV file needs format = \"csv\"",
                        shown(line.field(1))));
    const int commas = commas_in_place(name, line);
    physics::Site& site = table_.weather.site;
    const auto number = [&](int field, const char* what, double least, double most) {
        return number_in(name, line, field + commas, what, least, most);
    };
    site.latitude = number(7, "latitude [deg]", -90, 90);
    site.longitude = number(8, "longitude [deg]", -180, 180);
    site.utc_offset_h = number(9, "time zone [h]", -12, 14);
    site.elevation = number(10, "elevation [m]", -1000, 9000);
    check_zone(name, line, 9 + commas, site);
    table_.place = shown(line.field(2));
    for (int k = 1; k <= commas; ++k) table_.place += ", " + shown(line.field(2 + k));
}

void TableReader::check_data_periods(const Line& line) {
    if (number_in(table_.name, line, 2, "number of data periods", 1, 1000) != 1)
        fail_epw(table_.name, line.number, 2,
                 "several data periods: expected 1; write each to a file of its own");
    if (number_in(table_.name, line, 3, "records per hour", 1, 60) != 1)
        fail_epw(table_.name, line.number, 3,
                 "a sub-hourly file: expected 1 record per hour; average the rows of "
                 "each hour");
    constexpr int most_fields = 20;  // a row has more, one period 7
    if (n_filled(line) > most_fields)
        fail_epw(table_.name, line.number, 7,
                 "the first row stands in the line 'DATA PERIODS': put it into a line of "
                 "its own");
    said_end_ = month_and_day(line.field(7));
}

void TableReader::skip_to_data() {
    constexpr int most_header_lines = 100;
    std::optional<Line> line = lines_.next();
    while (line && line->is_blank()) line = lines_.next();
    if (!line)
        fail_epw(table_.name, 1, 1, "the file is empty: expected an EPW weather file");
    read_location(*line);
    while ((line = lines_.next()) && line->number <= most_header_lines)
        if (lower_case(line->field(1)) == "data periods")
            return check_data_periods(*line);
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
    if (line.field(4) == "0")
        fail_epw(table_.name, line.number, 4,
                 "hour (that ends here) = '0': expected a number from 1 to 24; where "
                 "hours run from 0 to 23, add 1 to all of them");
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
    const std::string what = fmt::format(
        "month {}, day {}, hour {}: expected month {}, day {}, hour {} of {}; {}", month,
        day, hour, step.month, step.day, step.hour + 1, step.year,
        again ? "sub-hourly or repeated rows cannot be read"
        : no_leap_day
            ? "the year has no 29 February: give a leap year"
            : "every hour must follow on the one before, or at most 48 h behind "
              "it");
    for (int n = 1; n <= longest_epw_gap; ++n)
        if (is_at(due + hours(n))) return leave_open(line, n, what);
    // Behind a row that was too late by itself, that one is the odd one.
    const bool is_behind = odd_row_.line + 1 == line.number;
    fail_epw(table_.name, is_behind ? odd_row_.line : line.number, 2,
             is_behind ? odd_row_.what : what);
}

/// Hours that have no row. Many of them are another step than an hour.
void TableReader::leave_open(const Line& line, int n, const std::string& what) {
    odd_row_ = {line.number, what};
    if (n_absent_ == 0) {
        first_absent_ = odd_row_;
        first_absent_time_ = physics::format_time(table_.weather.axis.end());
    }
    n_absent_ += n;
    ++n_gaps_;
    add_missing_hours(n, table_.weather);
    table_.lines.insert(table_.lines.end(), static_cast<std::size_t>(n), line.number);
}

void TableReader::check_absent() {
    if (n_absent_ == 0) return;
    if (n_absent_ > most_absent_share * n_rows_)
        fail_epw(table_.name, first_absent_.line, 2, first_absent_.what);
    table_.decisions.push_back(
        fmt::format("{}:{}: {} h in {} gap{} have no row, the first from {} on: taken as "
                    "missing",
                    table_.name, first_absent_.line, n_absent_, n_gaps_,
                    n_gaps_ == 1 ? "" : "s", first_absent_time_));
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
    ++n_rows_;
}

double TableReader::value_of(const Line& line, std::size_t c) {
    const EpwColumn& column = epw_columns[c];
    const std::string_view field = line.field(column.field);
    if (says_missing(field)) return nan;
    const std::optional<double> value = to_number<double>(field);
    if (value && *value >= column.missing) return nan;
    if (!value || *value < column.least || *value > column.most)
        return outside(line, c, value.value_or(nan));
    const bool negative_irradiance = column.least == -20 && *value < 0;
    n_negative_ += negative_irradiance;
    return negative_irradiance ? 0 : *value * column.scale;
}

[[noreturn]] void fail_value(const std::string& name, const EpwColumn& column, int line,
                             const std::string& value) {
    fail_epw(
        name, line, column.field,
        fmt::format("{} = '{}': expected a number from {} to {} {}, or {} where it is "
                    "missing",
                    column.name, value, column.least, column.most, column.unit,
                    column.missing));
}

/// Missing where it is not needed, or may yet turn out to be the code of a whole column.
double TableReader::outside(const Line& line, std::size_t c, double value) {
    const EpwColumn& column = epw_columns[c];
    const bool may_be_code = may_be_absent(column) && value < column.least;
    if (std::isnan(value) || (column.needed && !may_be_code))
        fail_value(table_.name, column, line.number, shown(line.field(column.field)));
    Ignored& ignored = ignored_[c];
    if (ignored.n++ == 0) ignored = {1, line.number, value, true};
    ignored.alike = ignored.alike && value == ignored.value;
    return nan;
}

/// A code that is not the format's is known where every hour holds it.
void TableReader::check_codes() {
    for (std::size_t c = 0; c < epw_columns.size(); ++c) {
        const EpwColumn& column = epw_columns[c];
        Ignored& ignored = ignored_[c];
        if (!column.needed || ignored.n == 0) continue;
        if (!ignored.alike || ignored.n < n_rows_)
            fail_value(table_.name, column, ignored.first_line,
                       fmt::format("{:g}", ignored.value));
        table_.decisions.push_back(
            fmt::format("{}:{}:{}: {}: {:g} in all hours taken as missing", table_.name,
                        ignored.first_line, column.field, column.name, ignored.value));
        ignored.n = 0;
    }
}

void TableReader::check_length() const {
    if (table_.weather.axis.n_steps > 0) return;
    fail_epw(
        table_.name, lines_.number(), 1,
        "only 0 hours: expected a whole year (8760, or 8784 in a leap year), or what "
        "of it the periods need; is the file cut off here?");
}

void TableReader::report() {
    const int year = physics::calendar_step(table_.weather.axis.start).year;
    if (other_years_)
        table_.decisions.push_back(fmt::format(
            "{}: rows of other years (a typical year?) taken as {}", table_.name, year));
    const physics::CalendarStep last =
        physics::calendar_step(table_.weather.axis.end() - hours(1));
    const std::string end = fmt::format("{}/{}", last.month, last.day);
    if (!said_end_.empty() && said_end_ != end)
        table_.decisions.push_back(
            fmt::format("{}:{}: its rows end on {}, the header says {}: is the file cut "
                        "off here?",
                        table_.name, table_.lines.back(), end, said_end_));
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

void add_missing_hours(int n, physics::Weather& weather) {
    for (const EpwColumn& column : epw_columns) {
        std::vector<double>& series = weather.*column.series;
        series.insert(series.end(), static_cast<std::size_t>(n), nan);
    }
    weather.axis.n_steps += n;
}

EpwTable parse_epw_table(std::string_view text, const std::string& name, int year) {
    return TableReader(text, name, year).read();
}

}  // namespace bemcal::input
