/// Makes the series that functions follow: hours by the wall clock, means of the weather,
/// loads of the calibrated model, time.
/// Holidays are those of any schedule of the case, and count as Sundays. School holidays
/// are left out.
#include "loop/function_drivers.hpp"

#include "effects/drivers.hpp"
#include "effects/profiles.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bemcal::loop {
namespace {

using Series = std::vector<double>;

/// Whether any of the case's schedules takes the day for a holiday.
bool is_holiday(const LoopData& data, const physics::CalendarStep& step) {
    return std::ranges::any_of(data.building.profiles, [&](const physics::Profile& one) {
        return !one.is_series &&
               std::ranges::any_of(one.schedule.holidays, [&](const auto& range) {
                   return range.contains(step);
               });
    });
}

std::string summer_time_of(const LoopData& data) {
    for (const physics::Profile& profile : data.building.profiles)
        if (!profile.is_series && profile.schedule.summer_time != "none")
            return profile.schedule.summer_time;
    return "none";
}

/// 0 working days, 1 Saturdays, 2 Sundays and holidays.
int class_of_day(const LoopData& data, const physics::CalendarStep& step) {
    if (is_holiday(data, step) || step.weekday == 6) return 2;
    return step.weekday == 5 ? 1 : 0;
}

/// Points of hours_of_week by the wall clock. [steps]
Series hours_of_week_over(const LoopData& data, const physics::TimeAxis& axis) {
    const std::string rule = summer_time_of(data);
    Series points;
    int day = -1, of_day = 0;
    for (int k = 0; k < axis.n_steps; ++k) {
        physics::Seconds time = axis.begin_of(k);
        if (physics::is_summer_time(time, rule, data.building.weather.site.utc_offset_h))
            time += std::chrono::hours(1);
        const physics::CalendarStep step = physics::calendar_step(time);
        if (step.day_of_year != day) {
            day = step.day_of_year;
            of_day = class_of_day(data, step);
        }
        points.push_back(24 * of_day + step.hour);
    }
    return points;
}

effects::Effect following_driver(effects::Driver driver, double lag_hours = 0) {
    effects::Effect effect;
    effect.driver = driver;
    if (lag_hours > 0) effect.shape = {effects::Form::lagged, lag_hours, 0};
    return effect;
}

/// What a function may follow: one row each.
struct DriverOfFunctions {
    const char* name;
    effects::Driver driver;
    double lag_hours;
};
constexpr DriverOfFunctions smooth_drivers[] = {
    {"outdoor temperature", effects::Driver::theta_e, 0},
    {"outdoor temperature of three days", effects::Driver::theta_e, 72},
    {"outdoor temperature of a month", effects::Driver::theta_e, 720},
    {"sun", effects::Driver::sun_horizontal, 0},
    {"wind", effects::Driver::wind, 0},
    {"moisture", effects::Driver::moisture, 0},
    {"heating load", effects::Driver::heating_load, 0},
    {"cooling load", effects::Driver::cooling_load, 0},
};
constexpr const char* nothing = "one";  // what the constant follows
constexpr const char* by_hours = "hour of the week";
constexpr const char* by_hours_and_weather = "hour and outdoor temperature of a day";
constexpr const char* by_time = "time";
constexpr double seconds_of_year = 365.25 * physics::day_s;

}  // namespace

FunctionDrivers function_drivers(const LoopData& data, const Place& place) {
    const physics::Drive& drive = *place.drive;
    const physics::TimeAxis& axis = drive.axis;
    effects::Surroundings around = *place.surroundings;
    around.building = &place.building;
    around.drive = &drive;
    FunctionDrivers all;
    all[nothing] = {Series(static_cast<std::size_t>(axis.n_steps), 0.0)};
    all[by_hours] = {hours_of_week_over(data, axis)};
    for (const DriverOfFunctions& row : smooth_drivers) {
        const effects::Effect effect = following_driver(row.driver, row.lag_hours);
        if (effects::is_known(effect, around))
            all[row.name] = {effects::profile_of(effect, around)};
    }
    Series hours = all[by_hours][0];
    for (double& hour : hours) hour = std::fmod(hour, 24) + (hour >= 24 ? 24 : 0);
    all[by_hours_and_weather] = {
        hours,
        effects::profile_of(following_driver(effects::Driver::theta_e, 24), around)};
    Series years;
    for (int k = 0; k < axis.n_steps; ++k)
        years.push_back(
            static_cast<double>((axis.begin_of(k) - data.training().from).count()) /
            seconds_of_year);
    all[by_time] = {years};
    return all;
}

std::string unit_of_driver(const std::string& name) {
    if (name == nothing) return "";
    if (name == by_hours) return "h";
    if (name == by_hours_and_weather) return "degC";
    if (name == by_time) return "a";
    const auto row = std::ranges::find(smooth_drivers, name, &DriverOfFunctions::name);
    return row == std::end(smooth_drivers) ? "" : effects::unit_of_values(row->driver);
}

std::vector<functions::Basis> bases_of(const FunctionDrivers& training,
                                       const physics::Drive& drive) {
    std::vector<functions::Basis> bases;
    for (const auto& [name, all] : training) {
        const std::vector<Series> series = of_period(all, drive);
        if (name == nothing)
            bases.push_back(functions::constant());
        else if (name == by_hours)
            bases.push_back(functions::hours_of_week(name, series[0]));
        else if (name == by_hours_and_weather)
            bases.push_back(functions::hours_times(name, series[0], series[1]));
        else if (name == by_time)
            bases.push_back(functions::wandering(name, series[0]));
        else
            bases.push_back(functions::smooth_of(name, series[0]));
    }
    return bases;
}

/// Without the warm-up.
std::vector<Series> of_period(std::vector<Series> all, const physics::Drive& drive) {
    for (Series& series : all)
        series.erase(series.begin(), series.begin() + drive.n_warm_up);
    return all;
}

}  // namespace bemcal::loop
