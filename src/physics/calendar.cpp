/// Calendar arithmetic on std::chrono, the notations of dates that users write, and the
/// rules of summer time.
/// Source: the Gregorian calendar; the rules are those of the EU since 1996 and the US
/// since 2007, applied to all years. Left out: other rules, changes of a zone's offset,
/// leap seconds.
#include "physics/calendar.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::physics {
namespace {

using std::chrono::days;
using std::chrono::hours;
using std::chrono::sys_days;
using std::chrono::year;
using std::chrono::year_month_day;

long long floor_div(long long a, long long b) {
    return a / b - (a % b != 0 && a % b < 0);
}

int to_step(long long step) {
    constexpr long long most = std::numeric_limits<int>::max();
    return static_cast<int>(std::clamp(step, -most, most));
}

/// Whether `text` has the form of `pattern`, in which # stands for a digit.
bool fits(std::string_view text, std::string_view pattern) {
    return std::equal(
        text.begin(), text.end(), pattern.begin(), pattern.end(),
        [](char c, char p) { return p == '#' ? c >= '0' && c <= '9' : c == p; });
}

int digits(std::string_view text, std::size_t position, std::size_t n) {
    int value = 0;
    for (char c : text.substr(position, n)) value = 10 * value + (c - '0');
    return value;
}

struct Date {
    int year, month, day;  ///< year 0 = every year
};

year_month_day chrono_date(const Date& date) {
    return year(date.year) / date.month / date.day;
}

/// "2021-03-05" or, where `yearly` are accepted, "03-05".
Date parse_date(std::string_view text, const std::string& whole, const char* expected) {
    const bool yearly = fits(text, "##-##");
    if (!yearly && !fits(text, "####-##-##"))
        throw std::invalid_argument(fmt::format("'{}': expected {}", whole, expected));
    const std::size_t at = yearly ? 0 : 5;
    const Date date{yearly ? 0 : digits(text, 0, 4), digits(text, at, 2),
                    digits(text, at + 3, 2)};
    // A yearly date may be 29 February: year 0 is a leap year.
    if (!chrono_date(date).ok())
        throw std::invalid_argument(fmt::format(
            "'{}': there is no day {} in month {}{}", whole, date.day, date.month,
            yearly ? std::string() : fmt::format(" of {}", date.year)));
    return date;
}

constexpr const char* expected_time =
    "a time like 2021-03-05 or 2021-03-05 14:30 (local standard time, without a zone)";
constexpr const char* expected_range =
    "days like 2021-12-24, 2021-12-24/2022-01-02, or 12-24/01-02 for every year";

std::chrono::seconds parse_clock(std::string_view text, const std::string& whole) {
    if (!fits(text, "##:##") && !fits(text, "##:##:##"))
        throw std::invalid_argument(
            fmt::format("'{}': expected {}", whole, expected_time));
    const int hour = digits(text, 0, 2), minute = digits(text, 3, 2);
    const int second = text.size() > 5 ? digits(text, 6, 2) : 0;
    const long long of_day = 3600LL * hour + 60 * minute + second;
    if (minute > 59 || second > 59 || of_day > day_s)
        throw std::invalid_argument(
            fmt::format("'{}': expected a time of day from 00:00 to 24:00", whole));
    return std::chrono::seconds(of_day);
}

/// The n-th Sunday of a month (n from 1), or the last one (n = 0).
sys_days sunday_of(int y, unsigned month, unsigned n) {
    const auto month_of_year = year(y) / std::chrono::month(month);
    if (n == 0) return sys_days(month_of_year / std::chrono::Sunday[std::chrono::last]);
    return sys_days(month_of_year / std::chrono::Sunday[n]);
}

}  // namespace

int TimeAxis::step_of(Seconds time) const {
    return to_step(floor_div((time - start).count(), step_s));
}

TimeAxis TimeAxis::between(Seconds from, Seconds to) const {
    const int first =
        std::clamp(step_of(from + std::chrono::seconds(step_s - 1)), 0, n_steps);
    const int last = std::clamp(step_of(to), first, std::max(first, n_steps));
    return {begin_of(first), step_s, last - first};
}

int month_at(Seconds time) {
    const CalendarStep step = calendar_step(time);
    return 12 * step.year + step.month;
}

const char* name_of_month(int month) {
    constexpr const char* names[] = {"January",   "February", "March",    "April",
                                     "May",       "June",     "July",     "August",
                                     "September", "October",  "November", "December"};
    return names[month - 1];
}

CalendarStep calendar_step(Seconds begin_of_step) {
    const sys_days day = std::chrono::floor<days>(begin_of_step);
    const year_month_day date(day);
    const auto hour = std::chrono::floor<hours>(begin_of_step - day);
    const unsigned weekday = std::chrono::weekday(day).iso_encoding() - 1;
    const days before = day - sys_days(date.year() / std::chrono::January / 1);
    return {static_cast<int>(date.year()),
            static_cast<int>(static_cast<unsigned>(date.month())),
            static_cast<int>(static_cast<unsigned>(date.day())),
            static_cast<int>(hour.count()),
            static_cast<int>(weekday),
            static_cast<int>(before.count()) + 1};
}

Seconds parse_time(const std::string& text) {
    const std::string_view view = text;
    const bool has_clock = view.size() > 10 && (view[10] == ' ' || view[10] == 'T');
    const std::string_view day = has_clock ? view.substr(0, 10) : view;
    if (!fits(day, "####-##-##"))
        throw std::invalid_argument(
            fmt::format("'{}': expected {}", text, expected_time));
    const Seconds midnight = sys_days(chrono_date(parse_date(day, text, expected_time)));
    return has_clock ? midnight + parse_clock(view.substr(11), text) : midnight;
}

std::string format_date(Seconds time) {
    const CalendarStep step = calendar_step(time);
    return fmt::format("{:04}-{:02}-{:02}", step.year, step.month, step.day);
}

std::string format_time(Seconds time) {
    const auto second = (time - std::chrono::floor<days>(time)).count();
    return fmt::format("{} {:02}:{:02}:{:02}", format_date(time), second / 3600,
                       second / 60 % 60, second % 60);
}

bool DateRange::contains(const CalendarStep& step) const {
    const bool yearly = first_year == 0;
    const auto key = [&](int y, int m, int d) {
        return ((yearly ? 0 : y) * 16 + m) * 32 + d;
    };
    const int first = key(first_year, first_month, first_day);
    const int last = key(last_year, last_month, last_day);
    const int now = key(step.year, step.month, step.day);
    if (first <= last) return first <= now && now <= last;
    return yearly && (now >= first || now <= last);
}

DateRange parse_date_range(const std::string& text) {
    const std::string_view view = text;
    const std::size_t slash = view.find('/');
    const Date first = parse_date(view.substr(0, slash), text, expected_range);
    const Date last = slash == std::string_view::npos
                          ? first
                          : parse_date(view.substr(slash + 1), text, expected_range);
    if ((first.year == 0) != (last.year == 0))
        throw std::invalid_argument(
            fmt::format("'{}': one day has a year and the other has none", text));
    if (first.year != 0 && sys_days(chrono_date(last)) < sys_days(chrono_date(first)))
        throw std::invalid_argument(
            fmt::format("'{}': the last day is before the first", text));
    return {first.year, first.month, first.day, last.year, last.month, last.day};
}

bool is_summer_time(Seconds local_standard, const std::string& rule,
                    double utc_offset_h) {
    if (rule == "none") return false;
    const int y = calendar_step(local_standard).year;
    if (rule == "us")  // 2:00 standard to 2:00 summer time
        return local_standard >= sunday_of(y, 3, 2) + hours(2) &&
               local_standard < sunday_of(y, 11, 1) + hours(1);
    if (rule == "eu") {  // both at 1:00 UTC
        const std::chrono::seconds offset(static_cast<long long>(utc_offset_h * 3600));
        const auto change = hours(1) + offset;
        return local_standard >= sunday_of(y, 3, 0) + change &&
               local_standard < sunday_of(y, 10, 0) + change;
    }
    throw std::invalid_argument(
        fmt::format("'{}': expected 'none', 'eu' or 'us' for summer time", rule));
}

}  // namespace bemcal::physics
