/// A small office under a made-up sky, two weeks in spring: a case for tests of studies.
#pragma once

#include "study/case.hpp"

#include <cmath>
#include <numbers>

namespace bemcal::test {

inline physics::Seconds day(int number) {
    using namespace std::chrono;
    return sys_days{year{2021} / April / 1} + days(number);
}

inline physics::Weather made_up_weather(int n_days) {
    physics::Weather weather;
    weather.site = {40, 10, 1, 100, 0.2};
    weather.axis = {day(0), 3600, 24 * n_days};
    for (int k = 0; k < weather.axis.n_steps; ++k) {
        const double hour = k % 24 + 0.5,
                     height = std::sin((hour - 6) / 12 * std::numbers::pi);
        weather.theta_e.push_back(11 + 7 * std::sin((hour - 9) / 12 * std::numbers::pi) +
                                  4 * std::sin(k / 60.0));
        weather.direct_normal.push_back(height > 0 ? 500 * height : 0);
        weather.diffuse_horizontal.push_back(height > 0 ? 150 * height : 0);
        weather.global_horizontal.push_back(
            height > 0 ? 500 * height * height + 150 * height : 0);
    }
    return weather;
}

inline physics::Schedule office_hours() {
    physics::Schedule schedule;
    schedule.name = "office_hours";
    for (std::size_t d = 0; d < 5; ++d)
        for (std::size_t h = 8; h < 18; ++h) schedule.week[d][h] = 1;
    schedule.holiday = schedule.week[6];
    return schedule;
}

inline physics::Building small_office() {
    physics::Building building;
    building.name = "small office";
    building.constructions.resize(1);
    building.constructions[0] = {"wall", {0.6, 0, -1}, 0.6, 0.9, 0.04};
    building.glazings.resize(1);
    building.glazings[0].name = "window";
    building.glazings[0].u_value.value = 2.5;
    building.glazings[0].solar_transmittance.value = 0.5;
    const int south = building.plane_index({std::numbers::pi / 2, std::numbers::pi, {}});
    physics::Zone zone;
    zone.name = "office";
    zone.floor_area = 200;
    zone.volume = 600;
    zone.surfaces.push_back(
        {"wall", 0, 150, physics::outdoors, 1, true, south, {1, 0, -1}});
    zone.windows.push_back({"window", 0, 40, south, {1, 0, -1}});
    zone.flows.push_back({"air", {0.8, 0, -1}, {0, 0, -1}, physics::outdoors});
    zone.loads.push_back(
        {"gains", {12, 2, 0}, 1, physics::Carrier::electricity, {1, 0, -1}});
    zone.thermostat.heating_set_point = {21, 16, 0};
    zone.thermostat.cooling_set_point = {25, 0, -1};
    building.zones.push_back(zone);
    return building;
}

inline physics::Parameter parameter(const physics::Building& building, const char* path,
                                    double least, double most, double nominal) {
    physics::Parameter made;
    made.name = path;
    made.unit = "-";
    made.least = least;
    made.most = most;
    made.nominal = nominal;
    made.targets = physics::resolve(building, path);
    return made;
}

/// Four weeks of weather; the training period is the second fortnight's first ten days.
inline study::Case small_case() {
    study::Case made;
    made.name = "small";
    made.building = small_office();
    made.weather = made_up_weather(28);
    made.profiles.push_back({"office_hours", false, office_hours(), {}, {}});
    made.parameters = {
        parameter(made.building, "zone.office.flow.air.air_change", 0.3, 1.5, 0.8),
        parameter(made.building, "glazing.window.solar_transmittance", 0.3, 0.7, 0.5),
        parameter(made.building, "zone.office.heating_set_point", 20, 22, 21)};
    made.periods = {{"training", day(7), day(17)}, {"held_out", day(17), day(24)}};
    made.warm_up_hours = 96;
    return made;
}

}  // namespace bemcal::test
