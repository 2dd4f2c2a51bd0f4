/// Makes the series that functions follow: hours by the wall clock, means of the weather,
/// loads of the model, time. Functions at one hook add up.
/// Holidays are those of any schedule, and count as Sundays. School holidays are left
/// out.
#include "effects/driver_functions.hpp"

#include "base/units.hpp"
#include "effects/decisions.hpp"
#include "effects/drivers.hpp"
#include "effects/hooks.hpp"
#include "effects/profiles.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bemcal::effects {
namespace {

using functions::Points;
using Series = std::vector<double>;

bool is_holiday(const WallClock& clock, const physics::CalendarStep& step) {
    return std::ranges::any_of(clock.holidays,
                               [&](const auto& range) { return range.contains(step); });
}

/// 0 working days, 1 Saturdays, 2 Sundays and holidays.
int class_of_day(const WallClock& clock, const physics::CalendarStep& step) {
    if (is_holiday(clock, step) || step.weekday == 6) return 2;
    return step.weekday == 5 ? 1 : 0;
}

/// Points::Kind::hours by the wall clock. [steps]
Series hours_of_week(const WallClock& clock, const physics::TimeAxis& axis) {
    Series points;
    points.reserve(static_cast<std::size_t>(axis.n_steps));
    int day = -1, of_day = 0;
    for (int k = 0; k < axis.n_steps; ++k) {
        physics::Seconds time = axis.begin_of(k);
        if (physics::is_summer_time(time, clock.summer_time, clock.utc_offset_h))
            time += std::chrono::hours(1);
        const physics::CalendarStep step = physics::calendar_step(time);
        if (step.day_of_year != day) {
            day = step.day_of_year;
            of_day = class_of_day(clock, step);
        }
        points.push_back(24 * of_day + step.hour);
    }
    return points;
}

/// Points::Kind::hours_at_knots: Saturdays and Sundays are one.
Series hours_of_two_days(Series hours_of_week) {
    for (double& hour : hours_of_week) hour = std::fmod(hour, 24) + (hour >= 24 ? 24 : 0);
    return hours_of_week;
}

Series years_of(const Surroundings& around) {
    const physics::TimeAxis& axis = around.drive->axis;
    Series years;
    years.reserve(static_cast<std::size_t>(axis.n_steps));
    for (int k = 0; k < axis.n_steps; ++k)
        years.push_back(static_cast<double>((axis.begin_of(k) - around.from).count()) /
                        seconds_of_year);
    return years;
}

/// What a function may follow: one row each. What is not of the weather or of the model
/// has Driver::one.
struct DriverOfFunctions {
    const char* name;
    Points::Kind points;
    Driver driver = Driver::one;
    double lag_hours = 0;
};
constexpr DriverOfFunctions rows[] = {
    {"one", Points::Kind::one},
    {"hour of the week", Points::Kind::hours},
    {"hour of the week from a day on", Points::Kind::hours_from},
    {"outdoor temperature", Points::Kind::knots, Driver::theta_e},
    {"outdoor temperature of three days", Points::Kind::knots, Driver::theta_e, 72},
    {"outdoor temperature of a month", Points::Kind::knots, Driver::theta_e, 720},
    {"sun", Points::Kind::knots, Driver::sun_horizontal},
    {"wind", Points::Kind::knots, Driver::wind},
    {"moisture", Points::Kind::knots, Driver::moisture},
    {"heating load", Points::Kind::knots, Driver::heating_load},
    {"cooling load", Points::Kind::knots, Driver::cooling_load},
    {"hour and outdoor temperature of a day", Points::Kind::hours_at_knots,
     Driver::theta_e, 24},
    {"time", Points::Kind::fortnights}};

const DriverOfFunctions& row_named(const std::string& name) {
    return *std::ranges::find(rows, name, &DriverOfFunctions::name);
}

Effect following(const DriverOfFunctions& row) {
    Effect effect;
    effect.driver = row.driver;
    if (row.lag_hours > 0) effect.shape = {Form::lagged, row.lag_hours, 0};
    effect.full_load = W_per_kW;
    return effect;
}

/// Nothing of what the weather or the model does not know.
std::vector<Series> series_of(const DriverOfFunctions& row, const Surroundings& around) {
    const physics::TimeAxis& axis = around.drive->axis;
    switch (row.points) {
        case Points::Kind::one:
            return {Series(static_cast<std::size_t>(axis.n_steps), 0.0)};
        case Points::Kind::hours:
            return {hours_of_week(around.clock, axis)};
        case Points::Kind::hours_from:
            return {hours_of_week(around.clock, axis), years_of(around)};
        case Points::Kind::fortnights:
            return {years_of(around)};
        default:
            break;
    }
    const Effect effect = following(row);
    if (!is_known(effect, around)) return {};
    Series values = profile_of(effect, around);
    if (row.points == Points::Kind::knots) return {std::move(values)};
    return {hours_of_two_days(hours_of_week(around.clock, axis)), std::move(values)};
}

/// A share that would take all away, or more, stops before.
void keep_in_domain(Hook hook, Series& column) {
    if (row_of(hook).kind != physics::ChangeKind::factor) return;
    for (double& value : column) value = std::max(value, decisions::least_of_function);
}

}  // namespace

FunctionDrivers function_drivers(const Surroundings& around) {
    FunctionDrivers all;
    for (const DriverOfFunctions& row : rows)
        if (auto series = series_of(row, around); !series.empty())
            all[row.name] = std::move(series);
    return all;
}

std::vector<std::string> function_driver_names() {
    std::vector<std::string> names;
    for (const DriverOfFunctions& row : rows) names.emplace_back(row.name);
    return names;
}

bool follows_loads(const std::string& driver) {
    return follows_loads(row_named(driver).driver);
}

Points::Kind points_of_driver(const std::string& name) {
    return row_named(name).points;
}

std::string unit_of_driver(const std::string& name) {
    const DriverOfFunctions& row = row_named(name);
    if (row.points == Points::Kind::hours || row.points == Points::Kind::hours_from)
        return "h";
    if (row.points == Points::Kind::fortnights) return "a";
    if (follows_loads(row.driver)) return "kW";
    return row.points == Points::Kind::one ? "" : unit_of_values(row.driver);
}

std::vector<double> sum_of(const std::vector<DriverFunction>& all,
                           const FunctionDrivers& drivers) {
    Series column(drivers.begin()->second[0].size(), 0.0);
    for (const DriverFunction& function : all) {
        const auto series = drivers.find(function.driver);
        if (series == drivers.end()) continue;
        const Series own =
            functions::function_over(function.points, function.values, series->second);
        for (std::size_t t = 0; t < own.size(); ++t) column[t] += own[t];
    }
    return column;
}

std::vector<double> column_of(Hook hook, const std::vector<DriverFunction>& all,
                              const FunctionDrivers& drivers) {
    Series column = sum_of(all, drivers);
    keep_in_domain(hook, column);
    return column;
}

}  // namespace bemcal::effects
