/// A small building and hand-made drives for the tests of physics.
#pragma once

#include "physics/building.hpp"
#include "physics/drive.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace bemcal::test {

/// A room of 20 m2: one wall, one south window, one air flow, one load; no heating or
/// cooling limits.
inline physics::Zone simple_zone(const std::string& name = "room") {
    physics::Zone zone;
    zone.name = name;
    zone.floor_area = 20;
    zone.volume = 50;
    physics::Surface wall;
    wall.name = "wall";
    wall.area = 30;
    zone.surfaces.push_back(wall);
    physics::Window window;
    window.name = "south";
    window.area = 4;
    zone.windows.push_back(window);
    physics::AirFlow infiltration;
    infiltration.name = "infiltration";
    infiltration.air_change.value = 0.5;
    zone.flows.push_back(infiltration);
    physics::Load equipment;
    equipment.name = "equipment";
    equipment.density.value = 5;
    equipment.carrier = physics::Carrier::electricity;
    zone.loads.push_back(equipment);
    return zone;
}

inline physics::Building simple_building() {
    physics::Building building;
    physics::Construction wall;
    wall.name = "wall";
    wall.u_value.value = 0.4;
    building.constructions.push_back(wall);
    physics::Glazing double_glazing;
    double_glazing.name = "double";
    double_glazing.u_value.value = 1.5;
    double_glazing.solar_transmittance.value = 0.6;
    building.glazings.push_back(double_glazing);
    building.planes.push_back({std::numbers::pi / 2, std::numbers::pi, {}});
    building.zones.push_back(simple_zone());
    return building;
}

/// Constant weather from midnight of 2021-01-01, with room for profiles.
inline physics::Drive constant_drive(const physics::Building& building, int n_steps,
                                     double theta_e, double irradiance = 0,
                                     int step_s = 3600, std::size_t n_profiles = 0) {
    using namespace std::chrono;
    physics::Drive drive;
    drive.axis.start = sys_days{year{2021} / January / 1};
    drive.axis.step_s = step_s;
    drive.axis.n_steps = n_steps;
    const auto n = static_cast<std::size_t>(n_steps);
    drive.theta_e.assign(n, theta_e);
    drive.irradiance = Matrix(building.planes.size(), n, irradiance);
    drive.profiles = Matrix(n_profiles, n);
    return drive;
}

/// The same with a day's swing of weather: temperature +- 6 K, sun from 6 to 18 h.
inline physics::Drive swinging_drive(const physics::Building& building, int n_steps,
                                     double theta_e, double irradiance,
                                     int step_s = 3600) {
    physics::Drive drive = constant_drive(building, n_steps, theta_e, 0, step_s);
    for (std::size_t step = 0; step < drive.theta_e.size(); ++step) {
        const double day = (static_cast<double>(step) + 0.5) * step_s / 86400;
        const double height = -std::cos(2 * std::numbers::pi * day);
        drive.theta_e[step] += 6 * height;
        for (std::size_t plane = 0; plane < building.planes.size(); ++plane)
            drive.irradiance(plane, step) = irradiance * std::max(0.0, height);
    }
    return drive;
}

}  // namespace bemcal::test
