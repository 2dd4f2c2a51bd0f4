/// The drivers' table: name, unit, first move, series and what the grammar makes of each.
/// Plain definitions, our own, base 20 degC. First moves are judgement; where one is 0,
/// the catalogue's thresholds are the only ones.
/// Moist air and sky are left to air, gates to gates, schedules to schedules.
#include "effects/drivers.hpp"

#include "effects/air.hpp"
#include "effects/decisions.hpp"
#include "effects/shapes.hpp"
#include "effects/steps.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace bemcal::effects {
namespace {

using physics::Weather;
using Series = std::vector<double>;
using Shapes = std::vector<Shape>;

using decisions::base_temperature;

/// Wind over its mean in all of the weather, less 1.
Series relative_wind(const Weather& weather) {
    const double mean = mean_of_known(weather.wind_speed);
    if (!(mean > 0)) return {};
    Series relative;
    relative.reserve(weather.wind_speed.size());
    for (const double wind : weather.wind_speed)
        relative.push_back(std::max(wind / mean - 1, decisions::least_excess_of_wind));
    return relative;
}

Series wind_and_difference(const Effect&, const Surroundings& around) {
    const Series& wind = around.weather.at(Driver::wind);
    if (wind.empty()) return {};
    return each_step(around, [&](std::size_t k) {
        return wind[k] * std::abs(base_temperature - around.drive->theta_e[k]);
    });
}

struct Weight {
    int plane;
    double area;
};

/// The planes that an effect on all facades sees: of windows for apertures, else of
/// opaque elements in the sun.
std::vector<Weight> facades_of(const Effect& effect, const physics::Building& building) {
    std::vector<Weight> weights;
    for (const physics::Zone& zone : building.zones) {
        if (effect.hook == Hook::aperture)
            for (const physics::Window& window : zone.windows)
                weights.push_back({window.plane, window.area});
        else
            for (const physics::Surface& surface : zone.surfaces)
                if (surface.in_sun && surface.boundary == physics::outdoors)
                    weights.push_back({surface.plane, surface.area});
    }
    return weights;
}

/// Irradiance on the effect's facade, or the mean over all by area.
Series sun_of(const Effect& effect, const Surroundings& around) {
    const Matrix& irradiance = around.drive->irradiance;
    const std::vector<Weight> weights = effect.facade
                                            ? std::vector<Weight>{{*effect.facade, 1}}
                                            : facades_of(effect, *around.building);
    if (effect.facade && *effect.facade >= static_cast<int>(irradiance.rows)) return {};
    double area = 0;
    Series sun(static_cast<std::size_t>(around.drive->n_steps()));
    for (const Weight& weight : weights) {
        const auto row = irradiance.row(static_cast<std::size_t>(weight.plane));
        for (std::size_t k = 0; k < sun.size(); ++k) sun[k] += weight.area * row[k];
        area += weight.area;
    }
    if (!(area > 0)) return {};
    for (double& value : sun) value /= area;
    return sun;
}

/// In steps: hours of one step share their matrices in the kernel.
Series in_steps_of_sun(Series sun) {
    constexpr double step = decisions::sun_step;
    for (double& value : sun) value = step * std::round(value / step);
    return sun;
}

/// What the room has whose window the sun is on.
Series sun_of_sunniest(const Surroundings& around) {
    const Matrix& irradiance = around.drive->irradiance;
    Series sun(static_cast<std::size_t>(around.drive->n_steps()));
    for (const physics::Zone& zone : around.building->zones)
        for (const physics::Window& window : zone.windows) {
            const auto row = irradiance.row(static_cast<std::size_t>(window.plane));
            for (std::size_t k = 0; k < sun.size(); ++k)
                sun[k] = std::max(sun[k], row[k]);
        }
    return sun;
}

Series sunniest_window(const Effect&, const Surroundings& around) {
    return in_steps_of_sun(sun_of_sunniest(around));
}

/// A room that had the sun is warm for hours.
Series sunniest_room(const Effect&, const Surroundings& around) {
    Series sun = sun_of_sunniest(around);
    const double kept =
        std::pow(decisions::kept_of_sun, around.drive->axis.step_s / 3600);
    for (std::size_t k = 1; k < sun.size(); ++k)
        sun[k] = std::max(sun[k], kept * sun[k - 1]);
    return in_steps_of_sun(std::move(sun));
}

const physics::Input& set_point_of(const physics::Thermostat& control, Hook hook) {
    return hook == Hook::cooling_set_point ? control.cooling_set_point
                                           : control.heating_set_point;
}

/// By how much the schedule of the hook's set-point is higher than an hour before: 1 in
/// the first hour of use; of several zones the largest.
Series plant_starts(const Effect& effect, const Surroundings& around) {
    const physics::Drive& drive = *around.drive;
    const int an_hour = std::max(1, static_cast<int>(3600 / drive.axis.step_s));
    Series starts(static_cast<std::size_t>(drive.n_steps()));
    for (const physics::Zone& zone : around.building->zones) {
        const int profile = set_point_of(zone.thermostat, effect.hook).profile;
        for (int k = an_hour; profile >= 0 && k < drive.n_steps(); ++k) {
            double& start = starts[static_cast<std::size_t>(k)];
            start = std::max(start, drive.profile_at(profile, k) -
                                        drive.profile_at(profile, k - an_hour));
        }
    }
    return starts;
}

Series elapsed_of(const Effect&, const Surroundings& around) {
    return each_step(around, [&](std::size_t k) {
        const auto begin = around.drive->axis.begin_of(static_cast<int>(k));
        return static_cast<double>((begin - around.from).count()) / elapsed_year_s;
    });
}

Series day_of_year(const Effect&, const Surroundings& around) {
    return each_step(around, [&](std::size_t k) {
        return around.calendar[k].day_of_year - 1 + clock_of(around, k) / 24;
    });
}

Series column_of(const Effect& effect, const Surroundings& around) {
    const auto found = around.columns.find(effect.column);
    return found == around.columns.end() ? Series{} : found->second;
}

Series ones(const Effect&, const Surroundings& around) {
    return each_step(around, [](std::size_t) { return 1.0; });
}

Shapes linear() {
    return {Shape{}};
}

Shapes windows_of_three_hours() {
    Shapes shapes;
    for (int from = 0; from < 24; from += 3)
        shapes.push_back({Form::within, double(from), double(from + 3)});
    return shapes;
}

Shapes two_months() {
    return windows({{0, 59}, {59, 120}, {120, 181}, {181, 243}, {243, 304}, {304, 366}});
}

Shapes hinges_of_temperature() {
    Shapes shapes = at_each(Form::below, {5, 10, 15});
    const Shapes above = at_each(Form::above, {15, 20, 25});
    shapes.insert(shapes.end(), above.begin(), above.end());
    return shapes;
}

Series share_of_load(const Effect& effect, const Series& load, double most) {
    return over(load, effect.full_load > 0 ? effect.full_load : most);
}

constexpr DriverRow driver_table[] = {
    {.driver = Driver::one,
     .name = "constant",
     .unit = "",
     .first_move = 0,
     .of_steps = ones,
     .grammar = {{{Follows::absence, linear, Gate::unoccupied}}}},
    {.driver = Driver::theta_e,
     .name = "outdoor temperature",
     .unit = "K",
     .first_move = 2,
     .of_steps = [](const Effect&,
                    const Surroundings& around) { return around.drive->theta_e; },
     .unit_of_threshold = "degC",
     .grammar = {{{Follows::temperature, hinges_of_temperature}}}},
    {.driver = Driver::temperature_to_base,
     .name = "temperature difference",
     .unit = "K",
     .first_move = 2,
     .of_steps =
         [](const Effect&, const Surroundings& around) {
             return each_step(around, [&](std::size_t k) {
                 return base_temperature - around.drive->theta_e[k];
             });
         }},
    {.driver = Driver::root_of_difference,
     .name = "root of the temperature difference",
     .unit = "K^0.5",
     .first_move = 0,
     .of_steps =
         [](const Effect&, const Surroundings& around) {
             return each_step(around, [&](std::size_t k) {
                 return std::sqrt(std::abs(base_temperature - around.drive->theta_e[k]));
             });
         }},
    {.driver = Driver::sky_difference,
     .name = "sky temperature difference",
     .unit = "K",
     .first_move = 0,
     .of_weather = sky_difference_series},
    {.driver = Driver::wind,
     .name = "wind",
     .unit = "m/s",
     .first_move = 0,
     .of_weather = [](const Weather& weather) { return weather.wind_speed; },
     .grammar = {{{Follows::wind, linear}}}},
    {.driver = Driver::relative_wind,
     .name = "wind about its mean",
     .unit = "",
     .first_move = 0,
     .of_weather = relative_wind},
    {.driver = Driver::wind_and_difference,
     .name = "wind x temperature difference",
     .unit = "K m/s",
     .first_move = 0,
     .of_steps = wind_and_difference},
    {.driver = Driver::sun_horizontal,
     .name = "global sun",
     .unit = "W/m2",
     .first_move = 50,
     .of_weather = [](const Weather& weather) { return weather.global_horizontal; },
     .grammar = {{{Follows::sun, linear}}}},
    {.driver = Driver::sun_on_facade,
     .name = "sun on the facade",
     .unit = "W/m2",
     .first_move = 50,
     .of_steps = sun_of},
    {.driver = Driver::sunniest_window,
     .name = "sun on the sunniest window",
     .unit = "W/m2",
     .first_move = 50,
     .of_steps = sunniest_window},
    {.driver = Driver::sunniest_room,
     .name = "sun that the sunniest room keeps",
     .unit = "W/m2",
     .first_move = 50,
     .of_steps = sunniest_room},
    {.driver = Driver::moisture,
     .name = "outdoor moisture",
     .unit = "g/kg",
     .first_move = 0,
     .of_weather = moisture_series,
     .grammar = {{{Follows::moisture, [] { return at_each(Form::above, {10}); }}}}},
    {.driver = Driver::ground,
     .name = "ground temperature",
     .unit = "K",
     .first_move = 0,
     .of_weather = ground_series},
    {.driver = Driver::yearly_mean,
     .name = "yearly mean outdoors",
     .unit = "",
     .first_move = 0,
     .of_weather = yearly_mean_series},
    {.driver = Driver::occupied,
     .name = "occupation",
     .unit = "",
     .first_move = 0,
     .of_steps = [](const Effect&,
                    const Surroundings& around) { return occupation_of(around); }},
    {.driver = Driver::plant_start,
     .name = "start of the plant",
     .unit = "",
     .first_move = 0,
     .of_steps = plant_starts},
    {.driver = Driver::hour,
     .name = "hour of the day",
     .unit = "h",
     .first_move = 1,
     .of_steps =
         [](const Effect&, const Surroundings& around) {
             return each_step(around, [&](std::size_t k) { return clock_of(around, k); });
         },
     .grammar = {{{Follows::hours, windows_of_three_hours, Gate::weekday}}}},
    {.driver = Driver::weekend,
     .name = "weekend",
     .unit = "",
     .first_move = 0,
     .of_steps = [](const Effect&,
                    const Surroundings& around) { return weekdays(around, 5, 6); },
     .grammar = {{{Follows::days, linear}}}},
    {.driver = Driver::saturday,
     .name = "Saturday",
     .unit = "",
     .first_move = 0,
     .of_steps = [](const Effect&,
                    const Surroundings& around) { return weekdays(around, 5, 5); },
     .grammar = {{{Follows::days, linear}}}},
    {.driver = Driver::sunday,
     .name = "Sunday",
     .unit = "",
     .first_move = 0,
     .of_steps = [](const Effect&,
                    const Surroundings& around) { return weekdays(around, 6, 6); },
     .grammar = {{{Follows::days, linear}}}},
    {.driver = Driver::day_of_year,
     .name = "day of the year",
     .unit = "d",
     .first_move = 14,
     .of_steps = day_of_year,
     .grammar = {{{Follows::seasons, two_months}}}},
    {.driver = Driver::elapsed,
     .name = "time elapsed",
     .unit = "a",
     .first_move = 0.04,
     .of_steps = elapsed_of,
     .grammar = {{{Follows::trend, linear}, {Follows::steps, dates}}}},
    {.driver = Driver::bright,
     .name = "brightness of the facade",
     .unit = "W/m2",
     .first_move = 50,
     .of_steps = sun_of},
    {.driver = Driver::heating_load,
     .name = "heating load",
     .unit = "",
     .first_move = 0,
     .of_steps =
         [](const Effect& effect, const Surroundings& around) {
             return share_of_load(effect, around.model.heating,
                                  around.model.most_heating);
         }},
    {.driver = Driver::cooling_load,
     .name = "cooling load",
     .unit = "",
     .first_move = 0,
     .of_steps =
         [](const Effect& effect, const Surroundings& around) {
             return share_of_load(effect, around.model.cooling,
                                  around.model.most_cooling);
         }},
    {.driver = Driver::another_day,
     .name = "another day's schedule",
     .unit = "",
     .first_move = 0,
     .of_steps = ones,
     .has_number = true},
    {.driver = Driver::shifted_hours,
     .name = "shifted schedule",
     .unit = "",
     .first_move = 1,
     .of_steps = ones,
     .has_number = true},
    {.driver = Driver::constant_temperature,
     .name = "constant temperature",
     .unit = "",
     .first_move = 2,
     .of_steps =
         [](const Effect& effect, const Surroundings& around) {
             return each_step(around, [&](std::size_t) { return effect.shape.at; });
         },
     .has_number = true},
    {.driver = Driver::column,
     .name = "column",
     .unit = "",
     .first_move = 0,
     .of_steps = column_of,
     .grammar = {{{Follows::columns, linear}}}},
};

constexpr bool driver_table_stands_in_order() {
    for (std::size_t k = 0; k < std::size(driver_table); ++k)
        if (driver_table[k].driver != static_cast<Driver>(k)) return false;
    return true;
}
static_assert(driver_table_stands_in_order(), "rows have another order than Driver");

}  // namespace

std::span<const DriverRow> driver_rows() {
    return driver_table;
}

bool follows_sun_on_facade(Driver driver) {
    return row_of(driver).of_steps == sun_of;
}

const DriverRow& row_of(Driver driver) {
    return driver_table[static_cast<std::size_t>(driver)];
}

const char* unit_of_values(Driver driver) {
    const DriverRow& row = row_of(driver);
    return row.unit_of_threshold != nullptr ? row.unit_of_threshold : row.unit;
}

std::vector<double> driver_of(const Effect& effect, const Surroundings& around) {
    const DriverRow& row = row_of(effect.driver);
    return row.of_weather != nullptr ? around.weather.at(row.driver)
                                     : row.of_steps(effect, around);
}

}  // namespace bemcal::effects
