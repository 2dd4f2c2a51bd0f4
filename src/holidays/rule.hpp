/// A row of a country's table of holidays: a name, a rule for its day, the years and
/// states in which it holds, and what happens where it falls on a weekend.
///
/// Rows are written with the words at the end of this file:
///     {"Labor Day", nth(1, monday, 9)},
///     {"Canada Day", on(7, 1), always, weekend_to_monday, "!NL"},
#pragma once

#include <array>
#include <span>

namespace bemcal::holidays {

enum Weekday { monday, tuesday, wednesday, thursday, friday, saturday, sunday };

enum class RuleKind {
    date,             ///< month and day
    nth_weekday,      ///< the n-th of a month; n = -1: the last
    weekday_from,     ///< the first on or after a date
    weekday_up_to,    ///< the last on or before a date
    weekday_nearest,  ///< the nearest to a date
    easter,           ///< days from Easter Sunday
    orthodox_easter,  ///< the same of the Orthodox Easter
    chinese,          ///< month and day of the Chinese calendar
    korean,           ///< the same of the Korean one
    qingming,         ///< the sun at 15 degrees, in Beijing
    spring_equinox,   ///< in Tokyo
    autumn_equinox,
    listed,            ///< by year, as 20210503
    between_holidays,  ///< each day, if no Sunday, that has a holiday on both sides
};

struct Rule {
    RuleKind kind = RuleKind::date;
    int month = 0, day = 0;  ///< from 1
    int weekday = 0;
    int n = 0;                     ///< of nth_weekday
    int offset = 0;                ///< days added at the end
    std::span<const int> dates{};  ///< of listed
    /// Where the day would be so many days from Easter, `avoid_by` are added.
    int avoid_easter = 0, avoid_by = 0;

    constexpr Rule plus(int days) const {
        Rule rule = *this;
        rule.offset += days;
        return rule;
    }
    constexpr Rule unless_easter(int days, int then_plus) const {
        Rule rule = *this;
        rule.avoid_easter = days;
        rule.avoid_by = then_plus;
        return rule;
    }
};

struct Years {
    int first = 0, last = 9999;
    int every = 1;  ///< only years that leave `rest` when divided by it
    int rest = 0;
    constexpr bool contains(int year) const {
        return year >= first && year <= last && year % every == rest;
    }
};

/// The day off for a holiday that falls on a weekend.
struct Substitute {
    /// Days from the holiday, by its weekday from Monday on; 0 = there is none.
    std::array<signed char, 7> shift{};
    bool moves = false;  ///< the day itself is none then
    /// From there on to the first day that is no holiday and has no shift itself.
    bool to_free = false;
    bool when_taken = false;  ///< also where another holiday stands on the day
};

struct Row {
    const char* name;
    Rule rule;
    Years years = {};
    Substitute substitute = {};
    /// Those that have it, "BW BY"; with ! in front, those that do not; "" = all.
    const char* states = "";
};

// The words of the tables.

constexpr Rule on(int month, int day) {
    return {.kind = RuleKind::date, .month = month, .day = day};
}
constexpr Rule nth(int n, Weekday weekday, int month) {
    return {.kind = RuleKind::nth_weekday, .month = month, .weekday = weekday, .n = n};
}
constexpr Rule last(Weekday weekday, int month) {
    return nth(-1, weekday, month);
}
constexpr Rule from(Weekday weekday, int month, int day) {
    return {RuleKind::weekday_from, month, day, weekday};
}
constexpr Rule up_to(Weekday weekday, int month, int day) {
    return {RuleKind::weekday_up_to, month, day, weekday};
}
constexpr Rule nearest(Weekday weekday, int month, int day) {
    return {RuleKind::weekday_nearest, month, day, weekday};
}
constexpr Rule easter(int days) {
    return {.kind = RuleKind::easter, .offset = days};
}
constexpr Rule orthodox(int days) {
    return {.kind = RuleKind::orthodox_easter, .offset = days};
}
constexpr Rule chinese(int month, int day) {
    return {.kind = RuleKind::chinese, .month = month, .day = day};
}
constexpr Rule korean(int month, int day) {
    return {.kind = RuleKind::korean, .month = month, .day = day};
}
constexpr Rule listed(std::span<const int> dates) {
    return {.kind = RuleKind::listed, .dates = dates};
}
constexpr Rule qingming{.kind = RuleKind::qingming};
constexpr Rule spring_equinox{.kind = RuleKind::spring_equinox};
constexpr Rule autumn_equinox{.kind = RuleKind::autumn_equinox};
constexpr Rule between_holidays{.kind = RuleKind::between_holidays};

constexpr Years always{};
constexpr Years since(int year) {
    return {.first = year};
}
constexpr Years until(int year) {
    return {.last = year};
}
constexpr Years only(int year) {
    return {.first = year, .last = year};
}

constexpr Substitute none{};
constexpr Substitute sunday_to_monday{.shift = {0, 0, 0, 0, 0, 0, 1}};
constexpr Substitute weekend_to_monday{.shift = {0, 0, 0, 0, 0, 2, 1}};
constexpr Substitute saturday_to_monday{.shift = {0, 0, 0, 0, 0, 2, 0}};
/// Saturday to Friday, Sunday to Monday.
constexpr Substitute to_nearest_weekday{.shift = {0, 0, 0, 0, 0, -1, 1}};
/// The next day that is neither weekend nor a holiday.
constexpr Substitute weekend_to_free{.shift = {0, 0, 0, 0, 0, 2, 1}, .to_free = true};
constexpr Substitute sunday_to_free{.shift = {0, 0, 0, 0, 0, 0, 1}, .to_free = true};

}  // namespace bemcal::holidays
