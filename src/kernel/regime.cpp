/// What a regime's coefficients follow from: its network, map and control, gains and
/// temperatures with and without drivers, the thermostat's lines.
/// Follows from network, step_map and structure. One network holds for the whole regime,
/// that of its first step. The kernel's columns are left to affine.
#include "kernel/regime.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

namespace bemcal::kernel {

std::size_t n_temperatures(const ZonePlan& plan, const physics::Building& building) {
    return building.boundaries.size() + (plan.shifted ? 3 : 0);
}

const physics::Input& temperature(const ZonePlan& plan, const physics::Building& building,
                                  std::size_t k) {
    const std::size_t n = building.boundaries.size();
    if (k < n) return building.boundaries[k].temperature;
    const physics::OutdoorShift& shift = building.zones[plan.zone].outdoor_shift;
    return k == n ? shift.supply : k == n + 1 ? shift.opaque : shift.windows;
}

Entrance entrance_of(const physics::Building& building, std::size_t k) {
    const std::size_t n = building.boundaries.size();
    if (k < n) return {k + 1, true, true, false};
    return {0, k == n + 1, k == n, k == n + 2};
}

Met Regime::per_driver(int profile) const {
    Met met;
    for (std::size_t k = 0; k < n_temperatures(plan, building); ++k) {
        const physics::Input& theta = temperature(plan, building, k);
        if (follows(theta, profile))
            met.add(entrance_of(building, k), along(theta, profile), network);
    }
    return met;
}

Met Regime::without_drivers() const {
    Met met;
    for (std::size_t k = 0; k < n_temperatures(plan, building); ++k)
        met.add(entrance_of(building, k),
                tabled(temperature(plan, building, k), plan.temperature_drivers, drive,
                       step()),
                network);
    return met;
}

/// phi_int per value of a profile that is a driver [W].
double per_load_driver(const Regime& regime, int profile) {
    double sum = 0;
    for (const physics::Load& load : regime.zone.loads)
        if (follows(load.density, profile))
            sum += regime.network.A_f * along(load.density, profile) * load.heat_fraction;
    return sum;
}

/// phi_int at a step, without the part that drivers bring [W].
double tabled_gain(const Regime& regime, int step) {
    double sum = 0;
    for (const physics::Load& load : regime.zone.loads)
        sum += regime.network.A_f * load.heat_fraction *
               tabled(load.density, regime.plan.load_drivers, regime.drive, step);
    return sum;
}

namespace {

Line line_of(double theta_set, double slope, double band, double limit) {
    if (limit <= 0) return {0, 0};
    const double gain = 1 / (slope + band / limit);
    return {theta_set * gain, gain};
}

[[noreturn]] void reject_season(const physics::Zone& zone) {
    throw CannotSimulate(fmt::format(
        "zone {}: heating_limit = {:.6g} degC or cooling_limit = {:.6g} degC is beyond "
        "what the ends of the parameters' ranges make of it",
        zone.name, zone.structure.heating_limit, zone.structure.cooling_limit));
}

}  // namespace

Line heating_line(const Regime& regime) {
    if (regime.control.imposed) return {0, 0};
    return line_of(regime.control.theta_H_set + 0.5 * regime.network.band,
                   regime.map.theta_air[physics::Term::phi_h], regime.network.band,
                   regime.control.phi_H_max);
}

Line cooling_line(const Regime& regime) {
    if (regime.control.imposed) return {0, 0};
    return line_of(regime.control.theta_C_set - 0.5 * regime.network.band,
                   -regime.map.theta_air[physics::Term::phi_c], regime.network.band,
                   regime.control.phi_C_max);
}

Regime make_regime(const ZonePlan& plan, int index, const physics::Building& building,
                   const physics::Drive& drive, physics::Network& network,
                   physics::StepMaps& maps) {
    const physics::Zone& zone = building.zones[plan.zone];
    const int step = plan.regimes.first[static_cast<std::size_t>(index)];
    if (index == 0 || plan.elements_vary)
        physics::make_elements(building, zone, drive, step, network);
    physics::make_air_flows(building, zone, drive, step, network);
    if (!plan.season.has(zone.structure)) reject_season(zone);
    const double dt = drive.axis.step_s;
    return {plan,
            index,
            building,
            zone,
            drive,
            network,
            physics::radiant_split(network),
            plan.is_standard() ? physics::standard_step_map(network, dt)
                               : maps.of(network, dt),
            physics::control_at(zone, drive, step)};
}

}  // namespace bemcal::kernel
