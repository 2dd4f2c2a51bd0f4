/// The products of air_hour in reverse.
/// Follows from physics/air_hour.cpp. A limit that shuts an economiser has no derivative.
#include "adjoint/air_hour_adjoint.hpp"

#include "adjoint/network_adjoint.hpp"

namespace bemcal::adjoint {

namespace {

/// The zone's outdoor air: its own and the system's.
void pull_flows(const PlaceBack& place, const physics::AirHour& of_hour) {
    const physics::Zone& zone = place.here();
    physics::Zone& of_zone = place.of_here();
    for (std::size_t k = 0; k < zone.flows.size(); ++k) {
        const physics::AirFlow& flow = zone.flows[k];
        const bool is_its = static_cast<int>(k) == zone.system_flow;
        const bool is_supplied = flow.supply != physics::outdoors;
        if (is_supplied && !is_its) continue;
        const double of_q = is_supplied ? of_hour.q_supplied
                            : is_its    ? of_hour.q_e
                                        : of_hour.q_inf;
        of_zone.volume += of_q * place.air_change(flow.air_change) / 3600;
        place.pull_air_change(flow.air_change, of_q * zone.volume / 3600,
                              of_zone.flows[k].air_change);
        if (is_its)
            place.pull(flow.heat_recovery, of_hour.heat_recovery,
                       of_zone.flows[k].heat_recovery);
    }
}

/// A room of outdoor air in the zone's water, where a fan starts.
void pull_fan_start(const PlaceBack& place, const physics::AirSystem& system,
                    double of_q_inf, physics::AirSystem& of_system) {
    const double start = physics::fan_start(system, place.drive, place.step);
    if (start <= 0) return;
    const double per_s = of_q_inf / place.drive.axis.step_s;
    place.of_here().volume += per_s * start;
    PlaceBack before = place;
    --before.step;
    const double of_available = per_s * place.here().volume;
    place.pull(system.available, of_available, of_system.available);
    before.pull(system.available, -of_available, of_system.available);
}

/// Air from a boundary: its temperature, and the outdoor air in it.
void pull_supplied(const PlaceBack& place, int boundary, const physics::AirSystem& system,
                   const physics::AirHour& of_hour, physics::AirSystem& of_system) {
    const auto row = static_cast<std::size_t>(boundary);
    place.pull(place.building.boundaries[row].temperature, of_hour.theta_supply,
               place.of_building.boundaries[row].temperature);
    place.of_here().volume +=
        of_hour.q_e * place.air_change(system.outdoor_air_change) / 3600;
    place.pull_air_change(system.outdoor_air_change,
                          of_hour.q_e * place.here().volume / 3600,
                          of_system.outdoor_air_change);
}

/// Returns the adjoint of the outdoor temperature in it.
double pull_reset(const physics::AirSystem& system, double theta_e, double of_reset,
                  physics::AirSystem& of_system) {
    const double wanted = system.supply_reset * (system.reset_below - theta_e);
    if (wanted <= 0) return 0;
    if (wanted >= system.most_reset) {
        of_system.most_reset += of_reset;
        return 0;
    }
    of_system.supply_reset += of_reset * (system.reset_below - theta_e);
    of_system.reset_below += of_reset * system.supply_reset;
    return -of_reset * system.supply_reset;
}

}  // namespace

void pull_air_hour(const physics::Building& building, std::size_t zone_index,
                   const physics::Drive& drive, int step, const physics::AirHour& of_hour,
                   physics::Building& of_building) {
    const PlaceBack place{building, zone_index, drive, step, of_building};
    const physics::Zone& zone = place.here();
    physics::Zone& of_zone = place.of_here();
    const auto row = static_cast<std::size_t>(zone.air_system);
    const physics::AirSystem& system = building.air_systems[row];
    physics::AirSystem& of_system = of_building.air_systems[row];
    const double theta_e = drive.theta_e[static_cast<std::size_t>(step)] +
                           place.at(zone.outdoor_shift.supply);
    pull_flows(place, of_hour);

    const double design_flow = place.at(system.design_flow),
                 fan_power = place.at(system.fan_power),
                 moisture = place.at(system.people_moisture);
    const double of_q_design = of_hour.q_design + of_hour.fan_power * fan_power * 1000;
    place.pull(system.fan_power,
               of_hour.fan_power * 1000 * design_flow * zone.floor_area / 3600,
               of_system.fan_power);
    place.pull(system.design_flow, of_q_design * zone.floor_area / 3600,
               of_system.design_flow);
    place.pull(system.people_moisture, of_hour.moisture * zone.floor_area / 3.6e6,
               of_system.people_moisture);
    of_zone.floor_area +=
        of_q_design * design_flow / 3600 + of_hour.moisture * moisture / 3.6e6;
    place.pull(system.available, of_hour.available, of_system.available);
    pull_fan_start(place, system, of_hour.q_inf, of_system);
    const int boundary = physics::supply_boundary(zone);
    double of_theta_e = of_hour.theta_e;
    if (boundary != physics::outdoors) {
        pull_supplied(place, boundary, system, of_hour, of_system);
    } else {
        place.pull(system.supply_temperature, of_hour.theta_supply,
                   of_system.supply_temperature);
        of_theta_e += pull_reset(system, theta_e, of_hour.theta_supply, of_system);
    }
    if (physics::open_economiser(system, drive, step, theta_e) != 0)
        place.pull(system.economiser, of_hour.economiser, of_system.economiser);
    of_system.least_flow += of_hour.least_flow;
    of_system.fan_exponent += of_hour.fan_exponent;
    of_system.fan_heat += of_hour.fan_heat;
    of_system.bypass_factor += of_hour.bypass_factor;
    of_system.coil_enthalpy += of_hour.coil_enthalpy * 1000;
    of_system.frost_limit += of_hour.frost_limit;
    of_system.least_humidity += of_hour.least_w / 1000;
    place.pull(zone.outdoor_shift.supply, of_theta_e, of_zone.outdoor_shift.supply);
}

}  // namespace bemcal::adjoint
