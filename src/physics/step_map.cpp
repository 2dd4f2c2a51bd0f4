/// The nodes' balances solved from the air inwards, each line on linear forms in place of
/// numbers.
#include "physics/step_map.hpp"

#include "physics/hour.hpp"

#include <cmath>

namespace bemcal::physics {

namespace {

LinearForm the(Term term) {
    LinearForm form;
    form.weight[static_cast<std::size_t>(term)] = 1;
    return form;
}

LinearForm operator+(LinearForm a, const LinearForm& b) {
    for (std::size_t k = 0; k < n_terms; ++k) a.weight[k] += b.weight[k];
    return a;
}

LinearForm operator*(double factor, LinearForm form) {
    for (double& weight : form.weight) weight *= factor;
    return form;
}

/// The emitter's first-order lag, exact for a constant command:
/// power(t) = command + (power(0) - command) exp(-t / tau).
struct Emitter {
    LinearForm mean, after;
};

Emitter make_emitter(double tau, double dt) {
    if (tau <= 0) return {the(Term::phi_h), {}};
    const double kept = std::exp(-dt / tau);
    const double mean_kept = -std::expm1(-dt / tau) * tau / dt;
    const LinearForm command = the(Term::phi_h), stored = the(Term::phi_emitter);
    return {mean_kept * stored + (1 - mean_kept) * command,
            kept * stored + (1 - kept) * command};
}

/// Everything that reaches the three nodes as power [W].
struct NodePowers {
    LinearForm ia, st, m;
};

NodePowers node_powers(const Network& network, const LinearForm& emitter) {
    const LinearForm radiant = network.radiant_share * emitter;
    const LinearForm convective = (1 - network.radiant_share) * emitter;
    const RadiantSplit split = radiant_split(network);
    return {the(Term::phi_ia) + convective + -1.0 * the(Term::phi_c),
            the(Term::phi_st) + split.to_st * radiant,
            the(Term::phi_m) + split.to_m * radiant};
}

}  // namespace

double LinearForm::at(const TermValues& terms) const {
    double sum = 0;
    for (std::size_t k = 0; k < n_terms; ++k) sum += weight[k] * terms.value[k];
    return sum;
}

StepMap make_step_map(const Network& network, double dt) {
    const double H_w = network.H_tr_w, H_em = network.H_tr_em, H_ms = network.H_tr_ms;
    const double H_is = network.H_tr_is, H_ve = network.H_ve;
    const Emitter emitter = make_emitter(network.tau_emitter, dt);
    const NodePowers phi = node_powers(network, emitter.mean);

    // air: (C_air/dt + H_ve + H_is) theta_air = air + H_is theta_s
    const double C_air = network.air_capacity / dt;
    const double D_air = C_air + H_ve + H_is;
    const LinearForm air =
        C_air * the(Term::theta_air) + H_ve * the(Term::theta_sup) + phi.ia;

    // surface, theta_air eliminated: D_s theta_s = surface + H_ms theta_m
    const double H_1 = H_is * ((C_air + H_ve) / D_air);
    const double H_2 = H_1 + H_w;
    const double D_s = H_ms + H_2;
    const LinearForm surface = H_w * the(Term::theta_e) + phi.st + (H_is / D_air) * air;

    // second mass, its mean eliminated: theta_m2 = kept theta_m2(0) + (1 - kept) theta_m
    const double C_second = 2 * network.C_2 / dt;
    const double kept = network.H_2 > 0 ? C_second / (C_second + network.H_2) : 1;
    const double H_second = network.H_2 * kept;

    // mass: D_m theta_m = mass, theta_m the mean of the step
    const double H_3 = H_ms * (H_2 / D_s);
    const double C_m = 2 * network.C_m / dt;
    const double D_m = C_m + H_em + H_3 + H_second;
    const LinearForm mass = C_m * the(Term::theta_m) + H_em * the(Term::theta_em) +
                            phi.m + H_second * the(Term::theta_m2) +
                            (H_ms / D_s) * surface;

    StepMap map;
    map.theta_m = (1 / D_m) * mass;
    map.theta_s = (1 / D_s) * (surface + H_ms * map.theta_m);
    map.theta_air = (1 / D_air) * (air + H_is * map.theta_s);
    map.theta_m_after = 2 * map.theta_m + -1.0 * the(Term::theta_m);
    map.theta_m2_after =
        (2 * kept - 1) * the(Term::theta_m2) + (2 * (1 - kept)) * map.theta_m;
    map.phi_emitter_after = emitter.after;
    map.phi_delivered = emitter.mean;
    return map;
}

}  // namespace bemcal::physics
