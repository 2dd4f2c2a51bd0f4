/// One step of a zone with refinements: the thermostat on top of the step's affine map,
/// both of its powers being clamps of a line, solved exactly.
/// Follows from the balances in structure.hpp and step_map; ISO 13790:2008, C.4.2 and
/// (C.12). Left out: part load, cooling through the emitter. Openings enter as a gain.
#include "physics/structure.hpp"

#include "physics/step_map.hpp"

#include <algorithm>

namespace bemcal::physics {

namespace {

TermValues terms_of(const HourDrive& drive, const NodeGains& gains,
                    const ZoneState& before) {
    return {{before.theta_m, before.theta_m2, before.theta_air, before.phi_emitter,
             drive.theta_em, drive.theta_e, drive.theta_sup, gains.phi_ia, gains.phi_st,
             gains.phi_m, 0, 0}};
}

/// Mean of max(power, together hottest, 0) over powers that lie evenly within `reach`
/// about what is asked; hottest = asked + reach.
double mean_of_rooms(double asked, double reach, double together) {
    if (!(reach > 0)) return std::max(asked, 0.0);
    const double hottest = asked + reach;
    if (together >= 1) return std::max(hottest, 0.0);
    const double span = 2 * reach / (1 - together);  // above it all ask for more
    const double some = std::clamp(hottest, 0.0, span);
    return some * (0.5 * (1 - together) * some / span + together) +
           std::max(hottest - span, 0.0);
}

struct Rooms {
    double spread;  ///< [K]
    double together;
};

/// power = limit clamp(1/2 + (theta_set - theta_air) / band, 0, 1), theta_air = free +
/// slope power, solved for the power. For cooling every sign turns. Without a band it is
/// the ideal thermostat; with a band and no limit, what holds theta_set + band / 2.
/// \param rooms  how they differ
/// \param missing  theta_set - free for heating, free - theta_set for cooling [K]
double thermostat_power(const Network& network, const Rooms& rooms, double missing,
                        double slope, double limit) {
    if (limit <= 0) return 0;
    const double droop = network.band / limit;  // of the set-point per power [K/W]
    const double asked = (missing + 0.5 * network.band) / (slope + droop);
    const double reach = 0.5 * rooms.spread / (slope + droop);
    return std::min(mean_of_rooms(asked, reach, rooms.together), limit);
}

struct Powers {
    double heating, cooling;
};

Powers control_powers(const Control& control, const Network& network, const StepMap& map,
                      double theta_air_free) {
    if (control.imposed)
        return {std::max(control.phi_imposed, 0.0), std::max(-control.phi_imposed, 0.0)};
    const double heating = thermostat_power(
        network, {control.room_spread, 0}, control.theta_H_set - theta_air_free,
        map.theta_air[Term::phi_h], control.phi_H_max);
    const double cooling =
        thermostat_power(network, {control.room_spread, control.together},
                         theta_air_free - control.theta_C_set,
                         -map.theta_air[Term::phi_c], control.phi_C_max);
    return {control.heated * heating, control.cooled * cooling};
}

NodeTemperatures temperatures(const StepMap& map, const TermValues& terms) {
    NodeTemperatures theta;
    theta.theta_m_t = map.theta_m_after.at(terms);
    theta.theta_m = map.theta_m.at(terms);
    theta.theta_s = map.theta_s.at(terms);
    theta.theta_air = map.theta_air.at(terms);
    theta.theta_op = 0.3 * theta.theta_air + 0.7 * theta.theta_s;
    return theta;
}

}  // namespace

StepResult advance_step(const Network& network, const HourDrive& drive,
                        const Control& control, const ZoneState& before, double dt) {
    const StepMap map = make_step_map(network, dt);
    const NodeGains gains = split_gains(network, drive);
    TermValues terms = terms_of(drive, gains, before);
    const Powers powers = control_powers(control, network, map, map.theta_air.at(terms));
    terms[Term::phi_h] = powers.heating;
    terms[Term::phi_c] = powers.cooling;

    StepResult result;
    result.theta = temperatures(map, terms);
    result.after = {result.theta.theta_m_t, map.theta_m2_after.at(terms),
                    result.theta.theta_air, map.phi_emitter_after.at(terms)};
    result.phi_heating = powers.heating;
    result.phi_cooling = powers.cooling;
    return result;
}

}  // namespace bemcal::physics
