/// Finds the days of a rule by arithmetic on the calendar.
/// Source: Easter by Meeus, Astronomical Algorithms, ch. 8 (also called Meeus/Jones/
/// Butcher); Qingming and the equinoxes by mean motions between leap days, the usual
/// rules of Chinese and Japanese almanacs, true from 2000 to 2050 and from 1980 to 2099.
/// Lunar months are in lunar.cpp. Left out: other years than these.
#include "holidays/dates.hpp"

#include "holidays/lunar.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace bemcal::holidays {
namespace {

using std::chrono::days;

/// From `day` on to the weekday, 0 to 6 days.
sys_days weekday_on_or_after(sys_days day, int weekday) {
    return day + days((weekday - weekday_of(day) + 7) % 7);
}

sys_days weekday_on_or_before(sys_days day, int weekday) {
    return day - days((weekday_of(day) - weekday + 7) % 7);
}

sys_days nth_weekday(int year, const Rule& rule) {
    if (rule.n > 0)
        return weekday_on_or_after(date_of(year, rule.month, 1), rule.weekday) +
               days(7 * (rule.n - 1));
    const auto month_of_year = std::chrono::year(year) / rule.month;
    return weekday_on_or_before(sys_days(month_of_year / std::chrono::last),
                                rule.weekday);
}

/// The day of a month on which a mean sun arrives that begins at `first` in `epoch`.
int mean_day(double first, int epoch, int year) {
    constexpr double beyond_365 = 0.242194;  // days of a year
    const int n = year - epoch;
    return static_cast<int>(std::floor(first + beyond_365 * n)) - n / 4;
}

std::vector<sys_days> listed_days(const Rule& rule, int year) {
    std::vector<sys_days> found;
    for (const int date : rule.dates)
        if (date / 10000 == year)
            found.push_back(date_of(year, date / 100 % 100, date % 100));
    return found;
}

std::vector<sys_days> lunar_days(const Rule& rule, int year) {
    const auto day = rule.kind == RuleKind::chinese
                         ? lunar_date(LunarCalendar::chinese, year, rule.month, rule.day)
                         : lunar_date(LunarCalendar::korean, year, rule.month, rule.day);
    return day ? std::vector<sys_days>{*day} : std::vector<sys_days>{};
}

std::vector<sys_days> without_offset(const Rule& rule, int year) {
    const auto date = [&] { return date_of(year, rule.month, rule.day); };
    switch (rule.kind) {
        case RuleKind::date:
            return {date()};
        case RuleKind::nth_weekday:
            return {nth_weekday(year, rule)};
        case RuleKind::weekday_from:
            return {weekday_on_or_after(date(), rule.weekday)};
        case RuleKind::weekday_up_to:
            return {weekday_on_or_before(date(), rule.weekday)};
        case RuleKind::weekday_nearest:
            return {weekday_on_or_after(date() - days(3), rule.weekday)};
        case RuleKind::easter:
            return {easter_sunday(year)};
        case RuleKind::orthodox_easter:
            return {orthodox_easter_sunday(year)};
        case RuleKind::chinese:
        case RuleKind::korean:
            return lunar_days(rule, year);
        case RuleKind::qingming:
            return {date_of(year, 4, mean_day(4.81, 2000, year))};
        case RuleKind::spring_equinox:
            return {date_of(year, 3, mean_day(20.8431, 1980, year))};
        case RuleKind::autumn_equinox:
            return {date_of(year, 9, mean_day(23.2488, 1980, year))};
        case RuleKind::listed:
            return listed_days(rule, year);
        case RuleKind::between_holidays:
            break;
    }
    throw std::logic_error("a rule that has no day by itself");
}

}  // namespace

sys_days date_of(int year, int month, int day) {
    return std::chrono::year(year) / month / day;
}

Weekday weekday_of(sys_days day) {
    return static_cast<Weekday>(std::chrono::weekday(day).iso_encoding() - 1);
}

int year_of(sys_days day) {
    return static_cast<int>(std::chrono::year_month_day(day).year());
}

sys_days easter_sunday(int year) {
    const int a = year % 19, b = year / 100, c = year % 100;
    const int g = (8 * b + 13) / 25;
    const int h = (19 * a + b - b / 4 - g + 15) % 30;
    const int l = (32 + 2 * (b % 4) + 2 * (c / 4) - h - c % 4) % 7;
    const int m = (a + 11 * h + 22 * l) / 451;
    const int month_and_day = h + l - 7 * m + 114;
    return date_of(year, month_and_day / 31, month_and_day % 31 + 1);
}

sys_days orthodox_easter_sunday(int year) {
    constexpr days behind(13);  // the Julian calendar, 1900 to 2099
    const int d = (19 * (year % 19) + 15) % 30;
    const int e = (2 * (year % 4) + 4 * (year % 7) - d + 34) % 7;
    const int month_and_day = d + e + 114;
    return date_of(year, month_and_day / 31, month_and_day % 31 + 1) + behind;
}

std::vector<sys_days> days_of(const Rule& rule, int year) {
    std::vector<sys_days> found = without_offset(rule, year);
    for (sys_days& day : found) {
        day += days(rule.offset);
        if (rule.avoid_by != 0 && day == easter_sunday(year) + days(rule.avoid_easter))
            day += days(rule.avoid_by);
    }
    return found;
}

}  // namespace bemcal::holidays
