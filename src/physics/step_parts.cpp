/// The nodes' balances eliminated from the air inwards, each line on forms in place of
/// numbers.
/// Source: ISO 13790:2008, (C.4) to (C.11); the refinements' balances are
/// structure.hpp's.
#include "physics/step_parts.hpp"

#include <cmath>

namespace bemcal::physics {

namespace {

Emitter make_emitter(double tau, double dt) {
    Emitter emitter;
    emitter.mean = the(Term::phi_h);
    if (tau <= 0) return emitter;
    const double kept = emitter.kept = std::exp(-dt / tau);
    const double mean_kept = emitter.mean_kept = -std::expm1(-dt / tau) * tau / dt;
    const LinearForm command = the(Term::phi_h), stored = the(Term::phi_emitter);
    emitter.mean = mean_kept * stored + (1 - mean_kept) * command;
    emitter.after = kept * stored + (1 - kept) * command;
    return emitter;
}

/// Everything that reaches the three nodes as power [W].
struct NodePowers {
    LinearForm ia, st, m;
};

NodePowers node_powers(const Network& network, const RadiantSplit& split,
                       const LinearForm& emitter) {
    const LinearForm radiant = network.radiant_share * emitter;
    const LinearForm convective = (1 - network.radiant_share) * emitter;
    return {the(Term::phi_ia) + convective + -1.0 * the(Term::phi_c),
            the(Term::phi_st) + split.to_st * radiant,
            the(Term::phi_m) + split.to_m * radiant};
}

}  // namespace

StepParts make_step_parts(const Network& network, double dt) {
    const double H_em = network.H_tr_em, H_ms = network.H_tr_ms, H_is = network.H_tr_is;
    StepParts p;
    p.split = radiant_split(network);
    p.emitter = make_emitter(network.tau_emitter, dt);
    const NodePowers phi = node_powers(network, p.split, p.emitter.mean);

    // air: (C_air/dt + H_ve + H_is) theta_air = air + H_is theta_s
    p.C_air = network.air_capacity / dt;
    p.D_air = p.C_air + network.H_ve + H_is;
    p.air = p.C_air * the(Term::theta_air) + network.H_ve * the(Term::theta_sup) + phi.ia;

    // surface, theta_air eliminated: D_s theta_s = surface + H_ms theta_m
    p.H_1 = H_is * ((p.C_air + network.H_ve) / p.D_air);
    p.H_2 = p.H_1 + network.H_tr_w;
    p.D_s = H_ms + p.H_2;
    p.surface = network.H_tr_w * the(Term::theta_e) + phi.st + (H_is / p.D_air) * p.air;

    // second mass, its mean eliminated: theta_m2 = kept theta_m2(0) + (1 - kept) theta_m
    p.C_second = 2 * network.C_2 / dt;
    p.kept_second = network.H_2 > 0 ? p.C_second / (p.C_second + network.H_2) : 1;
    p.H_second = network.H_2 * p.kept_second;

    // mass: D_m theta_m = mass, theta_m the mean of the step
    p.H_3 = H_ms * (p.H_2 / p.D_s);
    p.C_m = 2 * network.C_m / dt;
    p.D_m = p.C_m + H_em + p.H_3 + p.H_second;
    p.mass = p.C_m * the(Term::theta_m) + H_em * the(Term::theta_em) + phi.m +
             p.H_second * the(Term::theta_m2) + (H_ms / p.D_s) * p.surface;

    p.theta_m = (1 / p.D_m) * p.mass;
    p.theta_s = (1 / p.D_s) * (p.surface + H_ms * p.theta_m);
    return p;
}

StandardParts make_standard_parts(const Network& n, double dt) {
    StandardParts p;
    p.per_air = 1 / (n.H_tr_is + n.H_ve);
    p.k_1 = n.H_tr_is * p.per_air;
    p.H_1 = p.k_1 * n.H_ve;
    p.H_2 = p.H_1 + n.H_tr_w;
    p.per_surface = 1 / (n.H_tr_ms + p.H_2);
    p.to_mass = n.H_tr_ms * p.per_surface;
    p.C = n.C_m / dt;
    p.H = 0.5 * (p.to_mass * p.H_2 + n.H_tr_em);
    p.per_mass = 1 / (p.C + p.H);
    p.air_per_theta_m = p.k_1 * p.to_mass;
    return p;
}

}  // namespace bemcal::physics
