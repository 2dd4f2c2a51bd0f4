/// regime.hpp's and regime.cpp's sums and products in reverse.
#include "physics/regime_adjoint.hpp"

namespace bemcal::physics {

void RegimeBack::per_sol(const LinearForm& form, double g, LinearForm& of_form) {
    of_form[Term::phi_st] += g * regime.split.to_st;
    of_form[Term::phi_m] += g * regime.split.to_m;
    of_split.to_st += g * form[Term::phi_st];
    of_split.to_m += g * form[Term::phi_m];
}

void RegimeBack::per_int(const LinearForm& form, double g, LinearForm& of_form) {
    of_form[Term::phi_ia] += 0.5 * g;
    per_sol(form, 0.5 * g, of_form);
}

void RegimeBack::per_temperature(const LinearForm& form, std::size_t at, double g,
                                 LinearForm& of_form) {
    of_form[Term::theta_em] += g * regime.network.em_share[at];
    of_form[Term::theta_sup] += g * regime.network.ve_share[at];
    of_network.em_share[at] += g * form[Term::theta_em];
    of_network.ve_share[at] += g * form[Term::theta_sup];
}

void RegimeBack::fixed(const LinearForm& form, double g, LinearForm& of_form) {
    per_sol(form, -g * regime.network.phi_sky, of_form);
    of_network.phi_sky -= g * regime.per_sol(form);
    for (std::size_t b = 0; b < regime.building.boundaries.size(); ++b) {
        const Input& theta = regime.building.boundaries[b].temperature;
        Input& of_theta = place.of_building.boundaries[b].temperature;
        const bool varies = theta.profile >= 0;
        per_temperature(form, b + 1, g * (varies ? theta.low : theta.value), of_form);
        (varies ? of_theta.low : of_theta.value) +=
            g * regime.per_temperature(form, b + 1);
    }
}

void pull_load_driver(RegimeBack& back, int profile, double of_gain) {
    const Zone& zone = back.regime.zone;
    const double A_f = back.regime.network.A_f;
    for (std::size_t k = 0; k < zone.loads.size(); ++k) {
        const Load& load = zone.loads[k];
        if (load.density.profile != profile) continue;
        Load& of_load = back.place.of_here().loads[k];
        const double span = span_of(load.density);
        pull_span(of_gain * A_f * load.heat_fraction, of_load.density);
        of_load.heat_fraction += of_gain * A_f * span;
        back.of_network.A_f += of_gain * span * load.heat_fraction;
    }
}

void pull_tabled_gain(RegimeBack& back, int step, double of_gain) {
    const Regime& regime = back.regime;
    const double A_f = regime.network.A_f;
    for (std::size_t k = 0; k < regime.zone.loads.size(); ++k) {
        const Load& load = regime.zone.loads[k];
        Load& of_load = back.place.of_here().loads[k];
        const bool only_low = is_driver(regime.plan, load.density);
        const double density =
            only_low ? load.density.low : regime.drive.at(load.density, step);
        const double of_density = of_gain * A_f * load.heat_fraction;
        if (only_low)
            of_load.density.low += of_density;
        else
            pull_input(load.density, regime.drive, step, of_density, of_load.density);
        of_load.heat_fraction += of_gain * A_f * density;
        back.of_network.A_f += of_gain * density * load.heat_fraction;
    }
}

}  // namespace bemcal::physics
