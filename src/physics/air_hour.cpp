/// From flows and powers by floor area to those of a zone; the reset of the supply air,
/// the limit of the economiser.
/// Source: ASHRAE 90.1-2019, 6.5.1.1 (limits of economisers: dry bulb, differential dry
/// bulb, enthalpy). Left out: limits that follow the return air's enthalpy.
#include "physics/air_hour.hpp"

#include "base/error.hpp"
#include "physics/moist_air.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::physics {

namespace {

[[noreturn]] void reject_air(const Zone& zone, int step, const std::string& what) {
    throw CannotSimulate(
        fmt::format("air system of zone {}, step {}: {}", zone.name, step, what));
}

void check_air(const Zone& zone, int step, const AirHour& hour) {
    if (!(hour.q_design > 0) || !std::isfinite(hour.q_design))
        reject_air(zone, step,
                   fmt::format("design_flow makes {} m3/s, which is not above 0",
                               hour.q_design));
    if (!(hour.bypass_factor < 1))
        reject_air(zone, step,
                   fmt::format("bypass_factor = {} is not below 1", hour.bypass_factor));
    const struct {
        const char* name;
        double value;
    } numbers[] = {
        {"available", hour.available},         {"fan_power", hour.fan_power},
        {"people_moisture", hour.moisture},    {"outdoor air", hour.q_e},
        {"least_flow", hour.least_flow},       {"economiser", hour.economiser},
        {"bypass_factor", hour.bypass_factor}, {"coil_enthalpy", hour.coil_enthalpy}};
    for (const auto& number : numbers)
        if (!(number.value >= 0) || !std::isfinite(number.value))
            reject_air(
                zone, step,
                fmt::format("{} = {} is not a number >= 0", number.name, number.value));
}

}  // namespace

AirKind air_kind(const Building& building, const Zone& zone, const Drive& drive) {
    const AirSystem& system =
        building.air_systems[static_cast<std::size_t>(zone.air_system)];
    return {system.variable, !drive.w_e.empty(), drive.pressure,
            supply_boundary(zone) != outdoors};
}

int supply_boundary(const Zone& zone) {
    if (zone.system_flow < 0) return outdoors;
    return zone.flows[static_cast<std::size_t>(zone.system_flow)].supply;
}

double supply_reset(const AirSystem& system, double theta_e) {
    return std::clamp(system.supply_reset * (system.reset_below - theta_e), 0.0,
                      std::max(system.most_reset, 0.0));
}

double fan_start(const AirSystem& system, const Drive& drive, int step) {
    if (step == 0) return 0;
    return std::max(
        0.0, drive.at(system.available, step) - drive.at(system.available, step - 1));
}

double open_economiser(const AirSystem& system, const Drive& drive, int step,
                       double theta_e) {
    bool opens = true;
    if (system.limited_by == EconomiserLimit::dry_bulb)
        opens = theta_e < system.economiser_limit;
    else if (system.limited_by == EconomiserLimit::enthalpy && !drive.w_e.empty())
        opens = enthalpy(theta_e, drive.w_e[static_cast<std::size_t>(step)]) <
                1000 * system.economiser_limit;
    return opens ? drive.at(system.economiser, step) : 0;
}

AirHour air_hour(const Building& building, const Zone& zone, const Drive& drive,
                 int step) {
    const auto at = [&](const Input& input) { return drive.at(input, step); };
    const AirSystem& system =
        building.air_systems[static_cast<std::size_t>(zone.air_system)];
    AirHour hour;
    hour.theta_e =
        drive.theta_e[static_cast<std::size_t>(step)] + at(zone.outdoor_shift.supply);
    if (!drive.w_e.empty()) hour.w_e = drive.w_e[static_cast<std::size_t>(step)];
    for (std::size_t k = 0; k < zone.flows.size(); ++k) {
        const AirFlow& flow = zone.flows[k];
        const bool is_its = static_cast<int>(k) == zone.system_flow;
        if (flow.supply != outdoors && !is_its) continue;
        const double q = air_change_at(drive, flow.air_change, step) * zone.volume / 3600;
        if (flow.supply != outdoors)
            hour.q_supplied = q;
        else
            (is_its ? hour.q_e : hour.q_inf) += q;
        if (is_its) hour.heat_recovery = at(flow.heat_recovery);
    }
    const int supply = supply_boundary(zone);
    if (supply != outdoors)
        hour.q_e =
            air_change_at(drive, system.outdoor_air_change, step) * zone.volume / 3600;
    hour.moisture = at(system.people_moisture) * zone.floor_area / 3.6e6;
    hour.available = at(system.available);
    hour.q_inf += zone.volume / drive.axis.step_s * fan_start(system, drive, step);
    hour.q_design = at(system.design_flow) * zone.floor_area / 3600;
    hour.least_flow = system.least_flow;
    hour.fan_power = at(system.fan_power) * 1000 * hour.q_design;
    hour.fan_exponent = system.fan_exponent;
    hour.fan_heat = system.fan_heat;
    hour.theta_supply =
        supply == outdoors
            ? at(system.supply_temperature) + supply_reset(system, hour.theta_e)
            : at(building.boundaries[static_cast<std::size_t>(supply)].temperature);
    hour.bypass_factor = system.bypass_factor;
    hour.coil_enthalpy = 1000 * system.coil_enthalpy;
    hour.economiser = open_economiser(system, drive, step, hour.theta_e);
    hour.frost_limit = system.frost_limit;
    hour.least_w = system.least_humidity / 1000;
    return hour;
}

AirLoads system_loads(const Building& building, const Zone& zone, const Drive& drive,
                      int step, const AirLoads& asked, double theta_air) {
    AirHour hour = air_hour(building, zone, drive, step);
    check_air(zone, step, hour);
    hour.heating = asked.heating;
    hour.cooling = asked.cooling;
    hour.theta_air = theta_air;
    return supply(air_kind(building, zone, drive), hour);
}

}  // namespace bemcal::physics
