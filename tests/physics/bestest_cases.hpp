/// ASHRAE 140-2020 (BESTEST) section 5.2 as the Modelica Buildings library sets it up for
/// its 5R1C zone (Validation.BESTEST of ThermalZones.ISO13790): one table of cases, and
/// the building of each.
#pragma once

#include "physics/building.hpp"
#include "physics/drive.hpp"
#include "physics/network.hpp"

#include <numbers>
#include <string>
#include <vector>

namespace bemcal::test {

enum class Glass { clear, low_e, single };
enum class Envelope { usual, insulated };
enum class Weight { light, heavy };
enum class Facade { south, east_west };
enum class Regime { constant, setback, night_vent, tight };  ///< "tight": 20 degC, always

struct BestestCase {
    const char* name;
    Weight weight = Weight::light;
    Regime regime = Regime::constant;
    Facade facade = Facade::south;
    double shading = 1;  ///< F_sh,ob of the windows
    Glass glass = Glass::clear;
    Envelope envelope = Envelope::usual;
    bool free_floating = false;
};

constexpr double overhang = 0.84, fins = 0.846 * 0.915;

inline const std::vector<BestestCase>& bestest_cases() {
    using enum Weight;
    using enum Regime;
    using enum Facade;
    using enum Glass;
    using enum Envelope;
    static const std::vector<BestestCase> cases = {
        {"600", light},
        {"610", light, constant, south, overhang},
        {"620", light, constant, east_west},
        {"630", light, constant, east_west, fins},
        {"640", light, setback},
        {"650", light, night_vent},
        {"660", light, constant, south, 1, low_e},
        {"670", light, constant, south, 1, single},
        {"680", light, constant, south, 1, clear, insulated},
        {"685", light, tight},
        {"695", light, tight, south, 1, clear, insulated},
        {"900", heavy},
        {"910", heavy, constant, south, overhang},
        {"920", heavy, constant, east_west},
        {"930", heavy, constant, east_west, fins},
        {"940", heavy, setback},
        {"950", heavy, night_vent},
        {"980", heavy, constant, south, 1, clear, insulated},
        {"985", heavy, tight},
        {"995", heavy, tight, south, 1, clear, insulated},
        {"600FF", light, constant, south, 1, clear, usual, true},
        {"650FF", light, night_vent, south, 1, clear, usual, true},
        {"680FF", light, constant, south, 1, clear, insulated, true},
        {"900FF", heavy, constant, south, 1, clear, usual, true},
        {"950FF", heavy, night_vent, south, 1, clear, usual, true},
        {"980FF", heavy, constant, south, 1, clear, insulated, true},
    };
    return cases;
}

/// Rows of the drive's profiles.
enum BestestProfile { setback_hours, cooling_hours, vent_hours };

/// Heating set-point between 10 and 20 degC (a linear ramp from 7 to 8 h), cooling from 7
/// to 18 h, night ventilation from 18 to 7 h.
inline std::vector<physics::Profile> bestest_profiles() {
    std::vector<physics::Profile> profiles(3);
    for (std::size_t hour = 0; hour < 24; ++hour)
        for (std::size_t day = 0; day < 7; ++day) {
            const bool night = hour < 7 || hour == 23;
            profiles[setback_hours].schedule.week[day][hour] =
                hour == 7 ? 0.5 : (night ? 0 : 1);
            profiles[cooling_hours].schedule.week[day][hour] = hour >= 7 && hour < 18;
            profiles[vent_hours].schedule.week[day][hour] = hour < 7 || hour >= 18;
        }
    return profiles;
}

inline physics::Plane vertical(double azimuth_deg, std::vector<double> modifier = {}) {
    return {std::numbers::pi / 2, azimuth_deg * std::numbers::pi / 180,
            std::move(modifier)};
}

inline physics::Glazing bestest_glazing(const BestestCase& c) {
    physics::Glazing glazing;
    glazing.name = "window";
    glazing.incidence_factor = 1;
    glazing.frame_fraction = 0.001;
    switch (c.glass) {
        case Glass::clear:
            glazing.u_value.value = 3.1;
            glazing.solar_transmittance.value = c.free_floating ? 0.789 : 0.769;
            glazing.angle_modifier = {1, -0.189, 0.644, -0.596};
            break;
        case Glass::low_e:
            glazing.u_value.value = 1.45;
            glazing.solar_transmittance.value = 0.44;
            glazing.angle_modifier = {1, -0.152, 0.51, -0.526};
            break;
        case Glass::single:
            glazing.u_value.value = 7.8;
            glazing.solar_transmittance.value = 0.864;
            glazing.angle_modifier = {0.998, 0.137, -0.745, 1.21, -0.668};
            break;
    }
    return glazing;
}

inline std::vector<physics::Construction> bestest_constructions(const BestestCase& c) {
    std::vector<physics::Construction> constructions(3);
    const bool insulated = c.envelope == Envelope::insulated;
    const bool floating = c.free_floating;
    constructions[0].name = "wall";
    constructions[0].u_value.value = insulated ? 0.15 : (floating ? 0.534 : 0.53);
    constructions[1].name = "roof";
    constructions[1].u_value.value = insulated ? 0.10 : (floating ? 0.327 : 0.33);
    constructions[2].name = "floor";
    constructions[2].u_value.value = floating ? 0.0377 : 0.038;
    return constructions;
}

inline physics::Surface bestest_surface(const char* name, int construction, double area,
                                        int plane) {
    physics::Surface surface;
    surface.name = name;
    surface.construction = construction;
    surface.area = area;
    surface.plane = plane;
    return surface;
}

/// 8 x 6 x 2.7 m; the walls keep case 600's areas by facade in every case, as the
/// reference does.
inline void add_bestest_envelope(const BestestCase& c, physics::Building& building) {
    physics::Zone& zone = building.zones[0];
    const double areas[] = {21.6, 16.2, 9.6, 16.2};  // N, E, S, W
    const char* names[] = {"north", "east", "south", "west"};
    for (int k = 0; k < 4; ++k)
        zone.surfaces.push_back(bestest_surface(names[k], 0, areas[k],
                                                building.plane_index(vertical(90 * k))));
    zone.surfaces.push_back(
        bestest_surface("roof", 1, 48, building.plane_index(physics::Plane{})));
    zone.surfaces.push_back(bestest_surface("floor", 2, 48, 0));
    zone.surfaces.back().in_sun = false;
    const bool south = c.facade == Facade::south;
    for (double azimuth :
         south ? std::vector<double>{180} : std::vector<double>{90, 270}) {
        physics::Window window;
        window.name = "window";
        window.area = south ? 12 : 6;
        window.plane =
            building.plane_index(vertical(azimuth, building.glazings[0].angle_modifier));
        window.shading.value = c.shading;
        zone.windows.push_back(window);
    }
}

inline physics::AirFlow bestest_flow(const char* name, physics::Input air_change) {
    physics::AirFlow flow;
    flow.name = name;
    flow.air_change = air_change;
    const double reference_rho_c = 1.2 * 1005;
    flow.air_change.value *= reference_rho_c / physics::rho_c_air;
    return flow;
}

inline void set_bestest_control(const BestestCase& c, physics::Zone& zone) {
    physics::Thermostat& thermostat = zone.thermostat;
    thermostat.heating_set_point.value = 20;
    thermostat.cooling_set_point.value = 27;
    if (c.regime == Regime::setback)
        thermostat.heating_set_point = {20, 10, setback_hours};
    if (c.regime == Regime::tight) {
        thermostat.heating_set_point.value = 19.9;
        thermostat.cooling_set_point.value = 20.1;
    }
    if (c.regime == Regime::night_vent) {
        thermostat.heating_capacity.value = 0;
        thermostat.cooling_available = {1, 0, cooling_hours};
        zone.flows.push_back(bestest_flow("night", {1409 / zone.volume, 0, vent_hours}));
    }
    if (c.free_floating)
        thermostat.heating_capacity.value = thermostat.cooling_capacity.value = 0;
}

inline physics::Building bestest_building(const BestestCase& c) {
    physics::Building building;
    building.name = c.name;
    building.constructions = bestest_constructions(c);
    building.glazings = {bestest_glazing(c)};
    physics::Zone& zone = building.zones.emplace_back();
    const bool heavy = c.weight == Weight::heavy;
    zone.name = c.name;
    zone.floor_area = 48;
    zone.volume = 129.6;
    zone.surface_area_ratio = 171.6 / 48;
    zone.surface_film = 2.1;
    zone.heat_capacity = heavy ? 307750 : 42167;
    zone.mass_area_ratio = heavy ? 2.43 : 2.95;
    add_bestest_envelope(c, building);
    zone.flows.push_back(bestest_flow("infiltration", {0.414, 0, -1}));
    set_bestest_control(c, zone);
    physics::Load gains;
    gains.name = "gains";
    gains.density.value = 200 / 48.0;
    zone.loads.push_back(gains);
    return building;
}

}  // namespace bemcal::test
