/// One step of a zone as linear forms, from the eliminated nodes; and the standard's hour
/// written out.
/// Source: ISO 13790:2008, (C.4) to (C.11). The elimination is in step_parts, the
/// thermostat is left to structure and the kernel, the derivative to step_map_adjoint.
#include "physics/step_map.hpp"

#include "physics/step_parts.hpp"

namespace bemcal::physics {

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
    return map;
}

const StepMap& StepMaps::of(const Network& n, double dt) {
    const std::array numbers{
        dt,        n.A_m,     n.A_tot,       n.C_m,          n.H_tr_w,
        n.H_tr_em, n.H_tr_ms, n.H_tr_is,     n.H_ve,         n.air_capacity,
        n.H_2,     n.C_2,     n.tau_emitter, n.radiant_share};
    for (std::size_t k = 0; k < most_known; ++k) {
        const Known& known = known_[(last_ + most_known - k) % most_known];
        if (known.numbers == numbers) return known.map;
    }
    last_ = (last_ + 1) % most_known;
    known_[last_] = {numbers, make_step_map(n, dt)};
    return known_[last_].map;
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
