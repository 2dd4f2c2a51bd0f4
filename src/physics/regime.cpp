/// A regime's network, map and control; the gains and the thermostat's lines.
#include "physics/regime.hpp"

namespace bemcal::physics {

bool is_driver(const ZonePlan& plan, const Input& input) {
    for (int profile : plan.load_drivers)
        if (profile == input.profile) return true;
    return false;
}

/// phi_int per value of a profile that is a driver [W].
double per_load_driver(const Regime& regime, int profile) {
    double sum = 0;
    for (const Load& load : regime.zone.loads)
        if (load.density.profile == profile)
            sum += regime.network.A_f * span_of(load.density) * load.heat_fraction;
    return sum;
}

/// phi_int at a step, without the part that drivers bring [W].
double tabled_gain(const Regime& regime, int step) {
    double sum = 0;
    for (const Load& load : regime.zone.loads)
        sum +=
            regime.network.A_f * load.heat_fraction *
            (is_driver(regime.plan, load.density) ? load.density.low
                                                  : regime.drive.at(load.density, step));
    return sum;
}

namespace {

Line line_of(double theta_set, double slope, double band, double limit) {
    if (limit <= 0) return {0, 0};
    const double gain = 1 / (slope + band / limit);
    return {theta_set * gain, gain};
}

}  // namespace

Line heating_line(const Regime& regime) {
    if (regime.control.imposed) return {0, 0};
    return line_of(regime.control.theta_H_set + 0.5 * regime.network.band,
                   regime.map.theta_air[Term::phi_h], regime.network.band,
                   regime.control.phi_H_max);
}

Line cooling_line(const Regime& regime) {
    if (regime.control.imposed) return {0, 0};
    return line_of(regime.control.theta_C_set - 0.5 * regime.network.band,
                   -regime.map.theta_air[Term::phi_c], regime.network.band,
                   regime.control.phi_C_max);
}

Regime make_regime(const ZonePlan& plan, int index, const Building& building,
                   const Drive& drive, Network& network) {
    const Zone& zone = building.zones[plan.zone];
    const int step = plan.regimes.first[static_cast<std::size_t>(index)];
    make_network(building, zone, drive, step, network);
    const double dt = drive.axis.step_s;
    return {
        plan,
        building,
        zone,
        drive,
        network,
        radiant_split(network),
        plan.is_standard() ? standard_step_map(network, dt) : make_step_map(network, dt),
        control_at(zone, drive, step)};
}

}  // namespace bemcal::physics
