/// A schedule's value at every step: the day is chosen by the date (holiday, the last
/// period that holds, week), then its hour by the clock; a register's number multiplies
/// it.
/// Plain bookkeeping without a source. A step has the value of the hour in which it
/// begins; values are not interpolated. Rules of summer time are calendar.cpp's.
#include "physics/schedule.hpp"

#include <algorithm>

namespace bemcal::physics {
namespace {

bool any_contains(const std::vector<DateRange>& ranges, const CalendarStep& step) {
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](const DateRange& range) { return range.contains(step); });
}

const Day& day_of(const Schedule& schedule, const CalendarStep& step) {
    const auto weekday = static_cast<std::size_t>(step.weekday);
    if (any_contains(schedule.holidays, step)) return schedule.holiday;
    const auto period =
        std::find_if(schedule.periods.rbegin(), schedule.periods.rend(),
                     [&](const auto& p) { return p.dates.contains(step); });
    return period == schedule.periods.rend() ? schedule.week[weekday]
                                             : period->week[weekday];
}

/// What the register has for the day of a time.
double number_of_day(const Schedule& schedule, Seconds time) {
    if (!schedule.days) return 1;
    const auto found = schedule.days->find(std::chrono::floor<std::chrono::days>(time));
    return found == schedule.days->end() ? 0 : found->second;
}

}  // namespace

std::vector<double> values_of(const Schedule& schedule, const TimeAxis& axis,
                              double utc_offset_h) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(std::max(axis.n_steps, 0)));
    for (int k = 0; k < axis.n_steps; ++k) {
        const Seconds standard = axis.begin_of(k);
        const bool summer = is_summer_time(standard, schedule.summer_time, utc_offset_h);
        const Seconds local = standard + std::chrono::hours(summer ? 1 : 0);
        const CalendarStep step = calendar_step(local);
        values.push_back(day_of(schedule, step)[static_cast<std::size_t>(step.hour)] *
                         number_of_day(schedule, local));
    }
    return values;
}

}  // namespace bemcal::physics
