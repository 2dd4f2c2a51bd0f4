/// Random buildings whose zones have air systems, in moist and in dry weather.
#pragma once

#include "kernel/random_building.hpp"

namespace bemcal::physics::test {

inline AirSystem random_air_system(Dice& dice, int number) {
    AirSystem system;
    system.name = "system" + std::to_string(number);
    system.variable = dice.chance(0.6);
    system.limited_by = static_cast<EconomiserLimit>(dice.below(3));
    if (dice.chance(0.8)) system.available = {1, 0, office_hours};
    system.design_flow = random_input(dice, 6, 25, 0.1);
    system.fan_power = random_input(dice, 0.5, 2.5, 0.2);
    system.supply_temperature = random_input(dice, 11, 15, 0.2);
    system.people_moisture = random_input(dice, 1, 8, 0.7);
    if (dice.chance(0.5)) system.economiser = random_input(dice, 0.5, 1, 0.2);
    system.least_flow = dice.between(0.1, 0.5);
    system.fan_exponent = dice.between(1, 3);
    system.fan_heat = dice.between(0.5, 1);
    if (dice.chance(0.5)) system.supply_reset = dice.between(0.1, 0.6);
    system.bypass_factor = dice.between(0.05, 0.3);
    if (dice.chance(0.3)) system.coil_enthalpy = dice.between(12, 20);
    system.economiser_limit =
        system.limited_by == EconomiserLimit::enthalpy ? dice.between(40, 60) : 18;
    if (dice.chance(0.3)) system.frost_limit = dice.between(2, 12);
    if (dice.chance(0.3)) system.least_humidity = dice.between(4, 8);
    return system;
}

/// random_case, with a system for all zones, or one for each by chance.
inline RandomCase random_supplied_case(unsigned seed) {
    RandomCase made = random_case(seed);
    Dice dice(seed + 77000);
    Building& building = made.building;
    const bool one_for_all = dice.chance(0.5);
    for (Zone& zone : building.zones) {
        zone.thermostat.imposed = false;
        if (building.air_systems.empty() || !one_for_all)
            building.air_systems.push_back(
                random_air_system(dice, static_cast<int>(building.air_systems.size())));
        if (dice.chance(0.2) && building.zones.size() > 1) continue;
        zone.air_system = static_cast<int>(building.air_systems.size()) - 1;
        if (zone.flows[1].supply == outdoors && dice.chance(0.8)) zone.system_flow = 1;
    }
    Drive& drive = made.drive;
    if (dice.chance(0.8))
        for (const double theta : drive.theta_e)
            drive.w_e.push_back((0.004 + 0.0003 * std::max(theta, 0.0)) *
                                dice.between(0.7, 1.1));
    for (const char* path : {"air_system.*.design_flow", "air_system.*.bypass_factor",
                             "air_system.*.fan_power"})
        made.parameters.push_back(parameter(building, path, 0.9, 1.1, Effect::factor));
    made.parameters.push_back(
        parameter(building, "air_system.*.supply_temperature", -1, 0.5, Effect::offset));
    return made;
}

}  // namespace bemcal::physics::test
