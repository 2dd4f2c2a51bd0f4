/// An office that has everything an effect may ask for, under a made-up year of weather.
#pragma once

#include "effects/make_surroundings.hpp"
#include "effects/placement.hpp"
#include "physics/meters.hpp"
#include "physics/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

namespace bemcal::test {

using physics::Carrier;
using physics::Quantity;

inline constexpr int weather_days = 365;
inline constexpr int office_hours_row = 0, night_row = 1, ground_row = 2;

inline physics::Weather office_weather() {
    using std::numbers::pi;
    physics::Weather weather;
    weather.site = {52, 0, 0, 100, 0.2};
    weather.axis = {physics::parse_time("2021-01-01"), 3600, 24 * weather_days};
    for (int hour = 0; hour < weather.axis.n_steps; ++hour) {
        const double season = -std::cos(2 * pi * (hour / 24.0 - 20) / 365);
        const double day = -std::cos(2 * pi * (hour % 24 + 0.5 - 3) / 24);
        const double height =
            std::max(0.0, 0.4 + 0.3 * season - std::cos(2 * pi * (hour % 24 + 0.5) / 24));
        weather.theta_e.push_back(12 + 11 * season + 4 * day + 3 * std::sin(hour / 37.0));
        weather.global_horizontal.push_back(500 * height);
        weather.direct_normal.push_back(300 * height);
        weather.diffuse_horizontal.push_back(250 * height);
        weather.wind_speed.push_back(4 + 3 * std::sin(hour / 29.0) +
                                     std::cos(hour / 5.0));
        weather.relative_humidity.push_back(70 + 20 * std::sin(hour / 53.0));
        weather.cloud_cover.push_back(0.5 + 0.5 * std::sin(hour / 61.0));
    }
    return weather;
}

/// Weekdays 8 to 18 h; 24 December and the two days after it are closed.
inline physics::Profile office_profile() {
    physics::Profile profile;
    profile.name = "office hours";
    for (std::size_t day = 0; day < 5; ++day)
        for (std::size_t hour = 8; hour < 18; ++hour)
            profile.schedule.week[day][hour] = hour == 12 ? 0.7 : 1;
    profile.schedule.holidays.push_back(physics::parse_date_range("12-24/12-26"));
    return profile;
}

/// Every day from 6 to 22 h.
inline physics::Profile night_profile() {
    physics::Profile profile;
    profile.name = "set-back";
    for (physics::Day& day : profile.schedule.week)
        for (std::size_t hour = 6; hour < 22; ++hour) day[hour] = 1;
    return profile;
}

/// The ground: 8 degC, from June on 14.
inline physics::Profile ground_profile() {
    physics::Profile profile;
    profile.name = "ground";
    for (physics::Day& day : profile.schedule.week) day.fill(8);
    physics::Schedule::Period summer{physics::parse_date_range("06-01/11-30"), {}};
    for (physics::Day& day : summer.week) day.fill(14);
    profile.schedule.periods.push_back(summer);
    return profile;
}

inline physics::Load office_load(const char* name, double density, Carrier carrier) {
    physics::Load load;
    load.name = name;
    load.density = {density, 0.1 * density, office_hours_row};
    load.carrier = carrier;
    return load;
}

inline physics::Zone office_zone() {
    physics::Zone zone;
    zone.name = "office";
    zone.floor_area = 500;
    zone.volume = 1500;
    zone.surfaces = {{.name = "wall", .construction = 0, .area = 300, .plane = 0},
                     {.name = "roof", .construction = 1, .area = 250, .plane = 2},
                     {.name = "floor", .construction = 1, .area = 250, .in_sun = false}};
    zone.surfaces[2].boundary = 0;
    zone.windows = {{.name = "south", .glazing = 0, .area = 60, .plane = 0},
                    {.name = "west", .glazing = 0, .area = 30, .plane = 1}};
    zone.flows.resize(2);
    zone.flows[0].name = "infiltration";
    zone.flows[0].air_change.value = 0.4;
    zone.flows[1].name = "fans";
    zone.flows[1].air_change = {1, 0, office_hours_row};
    zone.flows[1].heat_recovery.value = 0.2;
    zone.loads = {office_load("people", 6, Carrier::none),
                  office_load("lights", 5, Carrier::electricity),
                  office_load("equipment", 7, Carrier::electricity)};
    zone.loads.push_back(office_load("hot water", 1, Carrier::gas));
    zone.loads.back().heat_fraction = 0;
    zone.thermostat.heating_set_point = {21, 16, night_row};
    zone.thermostat.cooling_set_point = {25, 30, office_hours_row};
    zone.thermostat.heating_capacity.value = 80;
    zone.thermostat.cooling_capacity.value = 80;
    return zone;
}

/// Of so large a flow that outdoor air is a small share of it.
inline physics::AirSystem office_air_system() {
    physics::AirSystem system;
    system.name = "unit";
    system.variable = false;
    system.available = {1, 0, office_hours_row};
    system.design_flow = {60};
    system.fan_power = {0.1};
    system.people_moisture = {3, 0, office_hours_row};
    return system;
}

inline physics::Building office_building() {
    using std::numbers::pi;
    physics::Building building;
    building.name = "office";
    building.constructions = {{.name = "wall", .u_value = {0.5, 0, -1}},
                              {.name = "roof", .u_value = {0.3, 0, -1}}};
    building.glazings.push_back({.name = "double",
                                 .u_value = {1.6, 0, -1},
                                 .solar_transmittance = {0.6, 0, -1},
                                 .angle_modifier = {}});
    building.planes = {{pi / 2, pi, {}}, {pi / 2, 1.5 * pi, {}}, {0, 0, {}}};
    building.boundaries.push_back({.name = "ground", .temperature = {1, 0, ground_row}});
    building.zones.push_back(office_zone());
    building.air_systems.push_back(office_air_system());
    building.zones[0].air_system = 0;
    building.zones[0].system_flow = 1;
    return building;
}

/// Owns what surroundings point to.
struct Office {
    physics::Weather weather = office_weather();
    physics::Building building = office_building();
    physics::Drive drive;
    effects::Surroundings around;

    explicit Office(const char* from = "2021-01-15", const char* to = "2021-12-31",
                    int step_s = 3600) {
        drive = physics::make_drive(
            weather, building, {office_profile(), night_profile(), ground_profile()},
            physics::parse_time(from), physics::parse_time(to), step_s, 14 * 24);
        around = effects::make_surroundings(building, drive, weather,
                                            physics::parse_time(from));
        around.columns["rain"] = around.weather.at(effects::Driver::wind);
        const physics::Trajectory before = physics::simulate(building, drive);
        const auto n_warm_up = static_cast<std::size_t>(drive.n_warm_up);
        around.model.heating.assign(n_warm_up, 0);
        around.model.cooling.assign(n_warm_up, 0);
        const physics::ZoneTrajectory& zone = before.zones[0];
        for (std::size_t k = 0; k < zone.heating.size(); ++k) {
            around.model.heating.push_back(zone.heating[k]);
            around.model.cooling.push_back(zone.cooling[k]);
        }
        around.model.most_heating = *std::ranges::max_element(zone.heating);
        around.model.most_cooling = *std::ranges::max_element(zone.cooling);
    }
    Office(const Office&) = delete;
    Office& operator=(const Office&) = delete;
};

/// What every meter shows at every step of the period with these coefficients, by
/// Quantity.
inline std::vector<std::vector<double>> all_shown(
    const effects::Placed& placed, const std::vector<double>& coefficients) {
    physics::Building building = placed.building;
    physics::apply(placed.building, placed.parameters, coefficients, building);
    const physics::Trajectory trajectory = physics::simulate(building, placed.drive);
    std::vector<std::vector<double>> meters;
    for (int quantity = 0; quantity < 6; ++quantity)
        meters.push_back(physics::predict(building, placed.drive, trajectory,
                                          static_cast<Quantity>(quantity)));
    return meters;
}

/// What a meter shows at every step of the period with these coefficients.
inline std::vector<double> shown(const effects::Placed& placed,
                                 const std::vector<double>& coefficients,
                                 Quantity quantity) {
    return all_shown(placed, coefficients)[static_cast<std::size_t>(quantity)];
}

inline double total(const std::vector<double>& steps) {
    return std::accumulate(steps.begin(), steps.end(), 0.0);
}

/// The total of a meter with one effect's coefficient minus that without.
inline double raised(const Office& office, const effects::Effect& effect,
                     double coefficient, Quantity quantity) {
    const effects::Placed placed = effects::place(std::span(&effect, 1), office.around);
    return total(shown(placed, {coefficient}, quantity)) -
           total(shown(placed, {0}, quantity));
}

}  // namespace bemcal::test
