/// From adjoints of a regime's forms and gains to those of the building: regime's sums
/// and products in reverse.
/// Follows from regime.hpp and regime.cpp by the product rule. The thermostat's lines are
/// taken back in affine_adjoint, networks in network_adjoint.
#include "kernel/regime_adjoint.hpp"

namespace bemcal::kernel {

void RegimeBack::per_radiant(const physics::LinearForm& form, double g,
                             physics::LinearForm& of_form) {
    of_form[physics::Term::phi_st] += g * regime.split.to_st;
    of_form[physics::Term::phi_m] += g * regime.split.to_m;
    of_split.to_st += g * form[physics::Term::phi_st];
    of_split.to_m += g * form[physics::Term::phi_m];
}

void RegimeBack::per_gain(const physics::LinearForm& form, double to_air, double g,
                          physics::LinearForm& of_form, double& of_to_air) {
    of_form[physics::Term::phi_ia] += to_air * g;
    per_radiant(form, (1 - to_air) * g, of_form);
    of_to_air += g * (form[physics::Term::phi_ia] - regime.per_radiant(form));
}

void RegimeBack::per_sol(const physics::LinearForm& form, double g,
                         physics::LinearForm& of_form) {
    per_gain(form, regime.network.sun_air_share, g, of_form, of_network.sun_air_share);
}

void RegimeBack::per_int(const physics::LinearForm& form, double g,
                         physics::LinearForm& of_form) {
    per_gain(form, regime.network.gains_air_share, g, of_form,
             of_network.gains_air_share);
}

void RegimeBack::per_theta_e(const physics::LinearForm& form, double g,
                             physics::LinearForm& of_form) {
    per_temperature(form, {0, true, true, true}, g, of_form);
}

void RegimeBack::per_temperature(const physics::LinearForm& form, const Entrance& at,
                                 double g, physics::LinearForm& of_form) {
    if (at.opaque) {
        of_form[physics::Term::theta_em] += g * regime.network.em_share[at.place];
        of_network.em_share[at.place] += g * form[physics::Term::theta_em];
    }
    if (at.supply) {
        of_form[physics::Term::theta_sup] += g * regime.network.ve_share[at.place];
        of_network.ve_share[at.place] += g * form[physics::Term::theta_sup];
    }
    if (at.windows) of_form[physics::Term::theta_e] += g;
}

void RegimeBack::per_driver(const physics::LinearForm& form, int profile, double g,
                            physics::LinearForm& of_form) {
    const physics::Building& building = regime.building;
    for (std::size_t k = 0; k < n_temperatures(regime.plan, building); ++k) {
        const physics::Input& theta = temperature(regime.plan, building, k);
        if (!follows(theta, profile)) continue;
        const Entrance at = entrance_of(building, k);
        per_temperature(form, at, g * along(theta, profile), of_form);
        pull_along(theta, profile, g * regime.per_temperature(form, at),
                   temperature(regime.plan, place.of_building, k));
    }
}

void RegimeBack::fixed(const physics::LinearForm& form, double g,
                       physics::LinearForm& of_form) {
    per_sol(form, -g * regime.network.phi_sky, of_form);
    of_network.phi_sky -= g * regime.per_sol(form);
    const physics::Building& building = regime.building;
    const std::vector<int>& drivers = regime.plan.temperature_drivers;
    for (std::size_t k = 0; k < n_temperatures(regime.plan, building); ++k) {
        const physics::Input& theta = temperature(regime.plan, building, k);
        const Entrance at = entrance_of(building, k);
        per_temperature(form, at, g * tabled(theta, drivers, regime.drive, regime.step()),
                        of_form);
        pull_tabled(theta, drivers, regime.drive, regime.step(),
                    g * regime.per_temperature(form, at),
                    temperature(regime.plan, place.of_building, k));
    }
}

void pull_load_driver(RegimeBack& back, int profile, double of_gain) {
    const physics::Zone& zone = back.regime.zone;
    const double A_f = back.regime.network.A_f;
    for (std::size_t k = 0; k < zone.loads.size(); ++k) {
        const physics::Load& load = zone.loads[k];
        if (!follows(load.density, profile)) continue;
        physics::Load& of_load = back.place.of_here().loads[k];
        const double span = along(load.density, profile);
        pull_along(load.density, profile, of_gain * A_f * load.heat_fraction,
                   of_load.density);
        of_load.heat_fraction += of_gain * A_f * span;
        back.of_network.A_f += of_gain * span * load.heat_fraction;
    }
}

void pull_tabled_gain(RegimeBack& back, int step, double of_gain) {
    const Regime& regime = back.regime;
    const double A_f = regime.network.A_f;
    for (std::size_t k = 0; k < regime.zone.loads.size(); ++k) {
        const physics::Load& load = regime.zone.loads[k];
        physics::Load& of_load = back.place.of_here().loads[k];
        const std::vector<int>& drivers = regime.plan.load_drivers;
        const double density = tabled(load.density, drivers, regime.drive, step);
        pull_tabled(load.density, drivers, regime.drive, step,
                    of_gain * A_f * load.heat_fraction, of_load.density);
        of_load.heat_fraction += of_gain * A_f * density;
        back.of_network.A_f += of_gain * density * load.heat_fraction;
    }
}

}  // namespace bemcal::kernel
