/// Hours of the week as one run a day: usual ones of a use, into a schedule and out of
/// it, and in words.
/// Usual hours are judgement, without a source.
/// Left out: runs through midnight, two runs a day, hours by season.
#include "physics/week_hours.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

namespace bemcal::physics {
namespace {

constexpr int hours_of_day = 24;

struct Usual {
    const char* use;
    WeekHours hours;
};
constexpr Usual usual_table[] = {{"office", {{{7, 18}, {}, {}}}},
                                 {"home", {{{6, 22}, {6, 22}, {6, 22}}}},
                                 {"school", {{{7, 16}, {}, {}}}},
                                 {"shop", {{{8, 20}, {8, 20}, {}}}}};

Day day_with(const DailyRun& run) {
    Day day{};
    for (int hour = run.from; hour < run.until; ++hour)
        day[static_cast<std::size_t>(hour)] = 1;
    return day;
}

Day numbered(DayKind kind) {
    Day day{};
    for (std::size_t hour = 0; hour < day.size(); ++hour)
        day[hour] = static_cast<double>(hour) + hours_of_day * static_cast<double>(kind);
    return day;
}

/// Puts a day of each kind into a schedule.
template <class DayOf>
void set_days(DayOf day_of, Schedule& schedule) {
    schedule.week.fill(day_of(DayKind::working_day));
    schedule.week[5] = day_of(DayKind::saturday);
    schedule.week[6] = schedule.holiday = day_of(DayKind::sunday);
    schedule.periods.clear();
    schedule.days.reset();
}

/// The only run of a day at `high`; nothing where it has two.
std::optional<DailyRun> run_of(const Day& day, double high) {
    const auto first = std::ranges::find(day, high);
    const auto last =
        std::find_if(first, day.end(), [&](double value) { return value != high; });
    if (std::find(last, day.end(), high) != day.end()) return std::nullopt;
    if (first == day.end()) return DailyRun{};
    return DailyRun{static_cast<int>(first - day.begin()),
                    static_cast<int>(last - day.begin())};
}

bool is_low_or_high(const Day& day, double low, double high) {
    return std::ranges::all_of(
        day, [&](double value) { return value == low || value == high; });
}

}  // namespace

int hours_apart(const DailyRun& one, const DailyRun& other) {
    const int common =
        std::max(0, std::min(one.until, other.until) - std::max(one.from, other.from));
    return one.until - one.from + other.until - other.from - 2 * common;
}

std::vector<DailyRun> all_runs() {
    std::vector<DailyRun> runs = {{}};
    runs.reserve(1 + hours_of_day * (hours_of_day + 1) / 2);
    for (int from = 0; from < hours_of_day; ++from)
        for (int until = from + 1; until <= hours_of_day; ++until)
            runs.push_back({from, until});
    return runs;
}

const char* name_of(DayKind kind) {
    constexpr const char* names[] = {"Monday to Friday", "Saturdays",
                                     "Sundays and holidays"};
    return names[static_cast<std::size_t>(kind)];
}

std::optional<WeekHours> usual_hours(std::string_view use) {
    for (const Usual& row : usual_table)
        if (row.use == use) return row.hours;
    return std::nullopt;
}

void set_hours(const WeekHours& hours, Schedule& schedule) {
    set_days(
        [&](DayKind kind) { return day_with(hours[static_cast<std::size_t>(kind)]); },
        schedule);
}

std::optional<WeekHours> hours_of(const Schedule& schedule) {
    if (!schedule.periods.empty() || schedule.days) return std::nullopt;
    const auto& week = schedule.week;
    const bool is_alike = std::all_of(week.begin(), week.begin() + 5,
                                      [&](const Day& day) { return day == week[0]; }) &&
                          (schedule.holidays.empty() || schedule.holiday == week[6]);
    if (!is_alike) return std::nullopt;
    double low = week[0][0], high = low;
    for (const Day& day : week) {
        low = std::min(low, std::ranges::min(day));
        high = std::max(high, std::ranges::max(day));
    }
    if (low == high) return std::nullopt;
    WeekHours hours;
    for (std::size_t kind = 0; kind < n_day_kinds; ++kind) {
        const Day& day = week[kind == 0 ? 0 : 4 + kind];
        const auto run = run_of(day, high);
        if (!run || !is_low_or_high(day, low, high)) return std::nullopt;
        hours[kind] = *run;
    }
    return hours;
}

Schedule numbered_hours(const Schedule& schedule) {
    Schedule made = schedule;
    set_days(numbered, made);
    return made;
}

bool runs_at(const WeekHours& hours, int numbered_hour) {
    const auto [kind, hour] = std::div(numbered_hour, hours_of_day);
    const DailyRun& run = hours[static_cast<std::size_t>(kind)];
    return hour >= run.from && hour < run.until;
}

std::string sentence_of(const DailyRun& run) {
    if (run.is_off()) return "off";
    if (run == DailyRun{0, hours_of_day}) return "all day";
    return fmt::format("{} to {} h", run.from, run.until);
}

std::string sentence_of(const WeekHours& hours) {
    std::string sentence;
    for (std::size_t kind = 0; kind < hours.size(); ++kind)
        sentence +=
            fmt::format("{}{} {}", kind == 0 ? "" : ", ",
                        name_of(static_cast<DayKind>(kind)), sentence_of(hours[kind]));
    return sentence;
}

}  // namespace bemcal::physics
