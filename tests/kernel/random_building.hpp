/// Buildings, drives and points drawn from a seed, over all options of the description:
/// what the fast kernel is compared with the plain version on.
#pragma once

#include "kernel/batch.hpp"

#include <cmath>
#include <random>

namespace bemcal::physics::test {

/// Numbers that do not depend on the standard library's distributions.
class Dice {
  public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    double between(double least, double most) {
        return least + (most - least) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    int below(int n) { return static_cast<int>(between(0, n)); }
    bool chance(double probability) { return between(0, 1) < probability; }

  private:
    std::mt19937_64 engine_;
};

/// Rows of the profiles that random drives have: three schedules and two series.
constexpr int office_hours = 0, two_levels = 1, many_levels = 2, series = 3,
              other_series = 4;
constexpr int n_profiles = 5;

struct RandomCase {
    Building building;
    std::vector<Parameter> parameters;
    Drive drive;
};

inline double profile_value(Dice& dice, int profile, int hour, int day) {
    const bool open = hour >= 8 && hour < 18 && day % 7 < 5;
    switch (profile) {
        case office_hours:
            return open ? 1 : 0;
        case two_levels:
            return hour >= 6 && hour < 22 ? 1 : 0.3;
        case many_levels:
            return open ? 0.25 * (hour % 5) : 0.1;
        default:
            return dice.between(0, 1);
    }
}

/// Weather by sine and dice; the first `n_warm_up` steps stand before the period.
inline Drive random_drive(Dice& dice, int step_s, int days, std::size_t n_planes) {
    Drive drive;
    const int per_hour = 3600 / step_s, n = days * 24 * per_hour;
    drive.axis = {parse_time("2021-01-26"), step_s, n};
    drive.n_warm_up = 4 * 24 * per_hour;
    const auto steps = static_cast<std::size_t>(n);
    drive.irradiance = Matrix(n_planes, steps);
    drive.profiles = Matrix(n_profiles, steps);
    const double mean = dice.between(-2, 24);
    for (std::size_t k = 0; k < steps; ++k) {
        const double hour = static_cast<double>(k) / per_hour;
        drive.theta_e.push_back(mean + 7 * std::sin((hour - 9) / 24 * 6.2832) +
                                6 * std::sin(hour / 240) + dice.between(-1, 1));
        const double height = std::sin((hour - 7) / 24 * 6.2832);
        for (std::size_t plane = 0; plane < n_planes; ++plane)
            drive.irradiance(plane, k) = height > 0 ? height * dice.between(50, 700) : 0;
        for (std::size_t p = 0; p < n_profiles; ++p)
            drive.profiles(p, k) =
                profile_value(dice, static_cast<int>(p), static_cast<int>(hour) % 24,
                              static_cast<int>(hour) / 24);
    }
    return drive;
}

/// `value`, by chance along one of the profiles up to `last`.
inline Input random_input(Dice& dice, double least, double most, double chance_of_profile,
                          int last = many_levels) {
    Input input{dice.between(least, most), dice.between(least, most), -1};
    if (dice.chance(chance_of_profile)) input.profile = dice.below(last + 1);
    return input;
}

inline void add_constructions(Dice& dice, Building& building) {
    for (const char* name : {"wall", "roof"})
        building.constructions.push_back({name, random_input(dice, 0.2, 1.2, 0.05)});
    Glazing glazing;
    glazing.u_value = random_input(dice, 0.8, 3, 0.1);
    glazing.solar_transmittance = random_input(dice, 0.3, 0.8, 0.1);
    building.glazings.push_back(glazing);
    building.boundaries.push_back({"ground", {dice.between(5, 15), 0, -1}});
    building.boundaries.push_back(
        {"neighbour", {dice.between(16, 24), dice.between(8, 16), series}});
}

inline void add_elements(Dice& dice, const Building& building, Zone& zone) {
    const int n_planes = static_cast<int>(building.planes.size());
    for (int plane = 0; plane < n_planes; ++plane) {
        Surface wall{"wall", plane % 2, dice.between(20, 60)};
        wall.plane = plane;
        wall.shading = random_input(dice, 0.5, 1, 0.1);
        zone.surfaces.push_back(wall);
        Window window{"window", 0, dice.between(2, 15), plane,
                      random_input(dice, 0.4, 1, 0.1)};
        if (dice.chance(0.8)) zone.windows.push_back(window);
    }
    for (int boundary = 0; boundary < 2; ++boundary)
        if (dice.chance(0.4))
            zone.surfaces.push_back(
                {"inner", 0, dice.between(10, 60), boundary, 1, false});
}

inline void add_gains(Dice& dice, Zone& zone) {
    zone.flows.push_back({"infiltration", random_input(dice, 0.1, 0.8, 0), {}, outdoors});
    AirFlow ventilation{"ventilation", random_input(dice, 0.2, 2, 0.7), {}, outdoors};
    if (dice.chance(0.3)) ventilation.supply = dice.below(2);
    if (ventilation.supply == outdoors && dice.chance(0.5))
        ventilation.heat_recovery = random_input(dice, 0.3, 0.8, 0.3);
    zone.flows.push_back(ventilation);
    const int n_loads = dice.below(5);
    for (int k = 0; k < n_loads; ++k) {
        Load load{"load", random_input(dice, 0, 15, 0.9, other_series),
                  dice.between(0, 1)};
        load.carrier = static_cast<Carrier>(dice.below(4));
        load.efficiency = random_input(dice, 0.5, 1, 0.2);
        zone.loads.push_back(load);
    }
}

inline void set_control(Dice& dice, Zone& zone) {
    Thermostat& control = zone.thermostat;
    control.heating_set_point = random_input(dice, 16, 21, 0.6);
    control.cooling_set_point = random_input(dice, 23.5, 28, 0.6);
    if (dice.chance(0.7)) control.heating_capacity = random_input(dice, 10, 60, 0.2);
    if (dice.chance(0.7)) control.cooling_capacity = random_input(dice, 5, 40, 0.2);
    if (dice.chance(0.3)) control.heating_available = {1, 0, office_hours};
    if (dice.chance(0.2)) control.cooling_capacity = {0, 0, -1};
    control.imposed = dice.chance(0.15);
    if (control.imposed)
        control.imposed_power = {dice.between(5, 40), dice.between(-15, 5), series};
    if (control.imposed && dice.chance(0.3)) control.imposed_power.profile = -1;
}

inline void set_structure(Dice& dice, Structure& structure) {
    if (dice.chance(0.5)) structure.air_capacity = dice.between(3000, 30000);
    if (dice.chance(0.5)) structure.proportional_band = dice.between(0.2, 2);
    if (dice.chance(0.5)) structure.emitter_time_constant = dice.between(600, 10000);
    if (dice.chance(0.5)) structure.emitter_radiant_share = dice.between(0.1, 0.8);
    if (dice.chance(0.5)) {
        structure.second_mass_conductance = dice.between(0.5, 4);
        structure.second_mass_capacity = dice.between(50000, 400000);
    }
}

inline Zone random_zone(Dice& dice, const Building& building, const std::string& name) {
    Zone zone;
    zone.name = name;
    zone.floor_area = dice.between(80, 400);
    zone.volume = 3 * zone.floor_area;
    zone.heat_capacity = dice.between(100000, 370000);
    zone.bridge_conductance = dice.chance(0.5) ? dice.between(0, 10) : 0;
    add_elements(dice, building, zone);
    add_gains(dice, zone);
    set_control(dice, zone);
    if (dice.chance(0.4)) set_structure(dice, zone.structure);
    // Without a limit, a perfect thermostat behind a lag amplifies rounding errors
    // without end.
    Input& capacity = zone.thermostat.heating_capacity;
    if (zone.structure.emitter_time_constant > 0)
        capacity = random_input(dice, 10, 60, 0.2);
    // Without a throw of the dice, so that what else is drawn stays what it was.
    const double fraction = std::fmod(zone.floor_area, 1);
    zone.gains_air_share = 0.3 + 0.5 * fraction;
    zone.sun_air_share = 0.3 * (1 - fraction);
    return zone;
}

inline void set_plant(Dice& dice, Plant& plant) {
    plant.heating_carrier = static_cast<Carrier>(1 + dice.below(3));
    plant.cooling_carrier = static_cast<Carrier>(1 + dice.below(3));
    plant.heating_efficiency = random_input(dice, 0.7, 0.95, 0.15);
    plant.cooling_cop = random_input(dice, 2, 4, 0.3, other_series);
}

inline Parameter parameter(const Building& building, const std::string& path,
                           double least, double most, Effect effect) {
    return {path,
            "-",
            least,
            most,
            effect,
            resolve(building, path),
            effect == Effect::factor ? 1.0 : 0.0};
}

inline std::vector<Parameter> random_parameters(const Building& building) {
    std::vector<Parameter> parameters;
    for (const char* path :
         {"construction.*.u_value", "zone.*.heat_capacity", "zone.*.floor_area",
          "zone.*.flow.*.air_change", "zone.*.heating_capacity", "glazing.*.u_value",
          "zone.*.air_capacity", "zone.*.emitter_time_constant", "plant.cooling_cop"})
        parameters.push_back(parameter(building, path, 0.8, 1.25, Effect::factor));
    for (const char* path : {"zone.*.heating_set_point", "zone.*.heating_set_point.low",
                             "boundary.*.temperature"})
        parameters.push_back(parameter(building, path, -1, 0.3, Effect::offset));
    return parameters;
}

/// Of dice of their own, so that the rest of a building stays what it was.
inline void set_rooms(unsigned seed, Building& building) {
    Dice dice(seed + 99000);
    for (Zone& zone : building.zones)
        if (zone.structure.any() && dice.chance(0.5))
            zone.thermostat.room_spread = {dice.between(0.5, 8), dice.between(0, 4),
                                           dice.chance(0.5) ? office_hours : -1};
    for (Zone& zone : building.zones)
        if (!zone.thermostat.imposed && dice.chance(0.5))
            zone.thermostat.cooled_together = {0, dice.between(0, 0.95), office_hours};
}

inline RandomCase random_case(unsigned seed) {
    Dice dice(seed);
    RandomCase made;
    Building& building = made.building;
    const int n_planes = 1 + dice.below(8);
    for (int plane = 0; plane < n_planes; ++plane)
        building.planes.push_back({1.5, 0.8 * plane, {}});
    add_constructions(dice, building);
    const int n_zones = dice.chance(0.3) ? 2 + dice.below(2) : 1;
    for (int zone = 0; zone < n_zones; ++zone)
        building.zones.push_back(
            random_zone(dice, building, "zone" + std::to_string(zone)));
    if (n_zones > 1 && dice.chance(0.25))
        building.zones[0].couplings.push_back({1, {dice.between(5, 80), 0, -1}, {}});
    set_plant(dice, building.plant);
    set_rooms(seed, building);
    made.parameters = random_parameters(building);
    made.drive =
        random_drive(dice, dice.chance(0.25) ? 600 : 3600, 40, building.planes.size());
    return made;
}

/// Rows of factors and offsets within the parameters' ranges.
inline Matrix random_points(unsigned seed, const std::vector<Parameter>& parameters,
                            std::size_t n) {
    Dice dice(seed);
    Matrix points(n, parameters.size());
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t p = 0; p < parameters.size(); ++p)
            points(k, p) = dice.between(parameters[p].least, parameters[p].most);
    return points;
}

}  // namespace bemcal::physics::test
