/// One step of a zone as linear forms: the nodes' balances eliminated from the air
/// inwards, each line on forms in place of numbers; and the standard's hour written out.
/// Source: ISO 13790:2008, (C.4) to (C.11); the refinements' balances are
/// structure.hpp's. The thermostat is left to structure and the kernel, the derivative to
/// step_map_adjoint.
#include "physics/step_parts.hpp"

#include <cmath>

namespace bemcal::physics {

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

double LinearForm::at(const TermValues& terms) const {
    double sum = 0;
    for (std::size_t k = 0; k < n_terms; ++k) sum += weight[k] * terms.value[k];
    return sum;
}

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

StepMap make_step_map(const Network& network, double dt) {
    const StepParts p = make_step_parts(network, dt);
    StepMap map;
    map.theta_m = p.theta_m;
    map.theta_s = p.theta_s;
    map.theta_air = (1 / p.D_air) * (p.air + network.H_tr_is * p.theta_s);
    map.theta_m_after = 2 * p.theta_m + -1.0 * the(Term::theta_m);
    map.theta_m2_after = (2 * p.kept_second - 1) * the(Term::theta_m2) +
                         (2 * (1 - p.kept_second)) * p.theta_m;
    map.phi_emitter_after = p.emitter.after;
    map.phi_delivered = p.emitter.mean;
    return map;
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

StepMap standard_step_map(const Network& n, double dt) {
    const StandardParts p = make_standard_parts(n, dt);
    const auto write = [&](double per_m, double per_st, double per_ia, LinearForm& form) {
        form[Term::theta_em] = n.H_tr_em * per_m;
        form[Term::theta_e] = n.H_tr_w * per_st;
        form[Term::theta_sup] = p.H_1 * per_st + n.H_ve * per_ia;
        form[Term::phi_m] = per_m;
        form[Term::phi_st] = per_st;
        form[Term::phi_ia] = p.k_1 * per_st + per_ia;
        form[Term::phi_h] = p.k_1 * per_st + per_ia;
    };
    const double m = p.per_mass, air_m = 0.5 * p.air_per_theta_m * m;
    StepMap map;
    write(m, p.to_mass * m, 0, map.theta_m_after);
    write(air_m, p.to_mass * air_m + p.k_1 * p.per_surface, p.per_air, map.theta_air);
    map.theta_m_after[Term::theta_m] = (p.C - p.H) * m;
    map.theta_air[Term::theta_m] = 0.5 * p.air_per_theta_m * (1 + (p.C - p.H) * m);
    return map;
}

}  // namespace bemcal::physics
