/// One hour of a zone line by line: gains split, mass node by Crank-Nicolson, surface and
/// air, the power that meets the set-points.
/// Source: ISO 13790:2008, C.1 to C.13 and C.4.2. H_1 / H_ve is written H_is / (H_is +
/// H_ve), the same number, so that no ventilation divides by zero; a slope replaces the
/// solve with 10 W/m2. Refinements are left to structure. Moisture is not modelled.
#include "physics/hour.hpp"

namespace bemcal::physics {

namespace {

/// Conductances of C.6 to C.8 [W/K], and k_1 = H_1 / H_ve [-].
struct Coupling {
    double H_1, H_2, H_3, k_1;
};

Coupling couple(const Network& n) {
    Coupling c;
    c.k_1 = n.H_tr_is / (n.H_tr_is + n.H_ve);
    c.H_1 = c.k_1 * n.H_ve;                           // (C.6)
    c.H_2 = c.H_1 + n.H_tr_w;                         // (C.7)
    c.H_3 = c.H_2 * n.H_tr_ms / (c.H_2 + n.H_tr_ms);  // (C.8)
    return c;
}

/// d theta_air / d phi_HC [K/W]: C.5, C.4, C.9, C.10 and C.11 differentiated in turn.
double air_slope(const Network& n, double dt) {
    const Coupling c = couple(n);
    const double per_mtot = n.H_tr_ms / (c.H_2 + n.H_tr_ms) * c.k_1;  // of C.5
    const double theta_m_t =
        per_mtot / (n.C_m / dt + 0.5 * (c.H_3 + n.H_tr_em));  // of C.4
    const double theta_m = 0.5 * theta_m_t;                   // of C.9
    const double theta_s =
        (n.H_tr_ms * theta_m + c.k_1) / (n.H_tr_ms + n.H_tr_w + c.H_1);  // of C.10
    return (n.H_tr_is * theta_s + 1) / (n.H_tr_is + n.H_ve);             // of C.11
}

double power_within(const Control& control, double phi_un) {
    if (phi_un > control.phi_H_max) return control.phi_H_max;    // case 1
    if (phi_un < -control.phi_C_max) return -control.phi_C_max;  // case 5
    return phi_un;                                               // cases 2 and 4
}

}  // namespace

RadiantSplit radiant_split(const Network& network) {
    const double to_m = network.A_m / network.A_tot;
    return {to_m, 1 - to_m - network.H_tr_w / (9.1 * network.A_tot)};
}

NodeGains split_gains(const Network& network, double phi_int, double phi_sol) {
    const RadiantSplit share = radiant_split(network);
    // 0.5 and 0 in the standard
    const double of_gains = network.gains_air_share, of_sun = network.sun_air_share;
    const double radiant = (1 - of_gains) * phi_int + (1 - of_sun) * phi_sol;
    return {of_gains * phi_int + of_sun * phi_sol,  // (C.1)
            share.to_st * radiant,                  // (C.3)
            share.to_m * radiant};                  // (C.2)
}

NodeGains split_gains(const Network& network, const HourDrive& drive) {
    NodeGains gains = split_gains(network, drive.phi_int, drive.phi_sol);
    const RadiantSplit share = radiant_split(network);
    gains.phi_ia += drive.phi_convective - drive.phi_vent;
    gains.phi_st += share.to_st * drive.phi_radiant;
    gains.phi_m += share.to_m * drive.phi_radiant;
    return gains;
}

NodeTemperatures advance_hour(const Network& n, const HourDrive& drive,
                              const NodeGains& gains, double theta_m_before,
                              double phi_hc, double dt) {
    const Coupling c = couple(n);
    // H_1 [theta_sup + (phi_ia + phi_HC) / H_ve], what reaches the surface node from the
    // air
    const double from_air = c.H_1 * drive.theta_sup + c.k_1 * (gains.phi_ia + phi_hc);
    const double at_surface = gains.phi_st + n.H_tr_w * drive.theta_e + from_air;
    const double H_3_by_H_2 = n.H_tr_ms / (c.H_2 + n.H_tr_ms);
    const double phi_mtot =
        gains.phi_m + n.H_tr_em * drive.theta_em + H_3_by_H_2 * at_surface;  // (C.5)

    NodeTemperatures theta;
    const double half = 0.5 * (c.H_3 + n.H_tr_em);
    theta.theta_m_t =
        (theta_m_before * (n.C_m / dt - half) + phi_mtot) / (n.C_m / dt + half);  // (C.4)
    theta.theta_m = 0.5 * (theta.theta_m_t + theta_m_before);                     // (C.9)
    theta.theta_s = (n.H_tr_ms * theta.theta_m + at_surface) /
                    (n.H_tr_ms + n.H_tr_w + c.H_1);  // (C.10)
    theta.theta_air =
        (n.H_tr_is * theta.theta_s + n.H_ve * drive.theta_sup + gains.phi_ia + phi_hc) /
        (n.H_tr_is + n.H_ve);                                      // (C.11)
    theta.theta_op = 0.3 * theta.theta_air + 0.7 * theta.theta_s;  // (C.12)
    return theta;
}

double power_for_set_point(const Network& network, const HourDrive& drive,
                           const NodeGains& gains, const Control& control,
                           double theta_m_before, double dt) {
    if (control.imposed) return control.phi_imposed;
    const double theta_air_0 =
        advance_hour(network, drive, gains, theta_m_before, 0, dt).theta_air;
    const bool heats = theta_air_0 < control.theta_H_set;
    const bool cools = theta_air_0 > control.theta_C_set;
    if (!heats && !cools) return 0;  // case 3
    const double theta_set = heats ? control.theta_H_set : control.theta_C_set;
    // (C.13): theta_air is linear in the power, so the slope replaces the solve with 10
    // W/m2
    const double phi_un = (theta_set - theta_air_0) / air_slope(network, dt);
    return power_within(control, phi_un);
}

}  // namespace bemcal::physics
