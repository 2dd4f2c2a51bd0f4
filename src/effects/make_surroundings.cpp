/// What effects follow: weather's hours laid on the drive's steps by the clock. Gaps hold
/// the value before them; before the weather begins its first day repeats.
/// Plain bookkeeping without a source. A series of which more than a tenth is missing
/// stays empty. Columns and the model's own series are left to the caller.
#include "effects/make_surroundings.hpp"

#include "effects/decisions.hpp"
#include "effects/drivers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bemcal::effects {
namespace {

using Series = std::vector<double>;

/// The weather's hour in which a step lies; before its first hour, that of the same hour
/// of its first day.
std::size_t hour_of(const physics::TimeAxis& weather, physics::Seconds time) {
    int hour = weather.step_of(time);
    if (hour < 0) hour = (hour % 24 + 24) % 24;
    return static_cast<std::size_t>(std::min(hour, weather.n_steps - 1));
}

/// Gaps hold the value before them, a first gap the one after it.
void fill(Series& values) {
    const auto known = [](double value) { return !std::isnan(value); };
    double last = *std::find_if(values.begin(), values.end(), known);
    for (double& value : values) {
        if (known(value)) last = value;
        value = last;
    }
}

/// An hourly series on the drive's steps; empty where it is not there.
Series lay(const Series& hourly, const physics::Weather& weather,
           const physics::Drive& drive) {
    if (hourly.size() != static_cast<std::size_t>(weather.axis.n_steps)) return {};
    Series steps(static_cast<std::size_t>(drive.n_steps()));
    double n_missing = 0;
    for (int step = 0; step < drive.n_steps(); ++step) {
        const double value = hourly[hour_of(weather.axis, drive.axis.begin_of(step))];
        steps[static_cast<std::size_t>(step)] = value;
        n_missing += std::isnan(value) ? 1 : 0;
    }
    if (n_missing > decisions::most_missing * drive.n_steps()) return {};
    fill(steps);
    return steps;
}

std::vector<physics::CalendarStep> calendar_of(const physics::TimeAxis& axis) {
    std::vector<physics::CalendarStep> calendar;
    calendar.reserve(static_cast<std::size_t>(axis.n_steps));
    for (int step = 0; step < axis.n_steps; ++step)
        calendar.push_back(physics::calendar_step(axis.begin_of(step)));
    return calendar;
}

}  // namespace

WallClock wall_clock_of(const std::vector<physics::Profile>& profiles,
                        const physics::Site& site) {
    WallClock clock;
    clock.utc_offset_h = site.utc_offset_h;
    for (const physics::Profile& profile : profiles) {
        if (profile.is_series) continue;
        const physics::Schedule& schedule = profile.schedule;
        clock.holidays.insert(clock.holidays.end(), schedule.holidays.begin(),
                              schedule.holidays.end());
        if (clock.summer_time == "none") clock.summer_time = schedule.summer_time;
    }
    return clock;
}

Surroundings make_surroundings(const physics::Building& building,
                               const physics::Drive& drive,
                               const physics::Weather& weather, physics::Seconds from) {
    Surroundings around;
    around.building = &building;
    around.drive = &drive;
    around.calendar = calendar_of(drive.axis);
    for (const DriverRow& row : driver_rows())
        if (row.of_weather != nullptr)
            around.weather[row.driver] = lay(row.of_weather(weather), weather, drive);
    around.from = from;
    return around;
}

}  // namespace bemcal::effects
