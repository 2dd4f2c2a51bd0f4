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

namespace {

/// Of Met::add: to the network's shares; returns the adjoint of the value.
double pull_added(const Entrance& at, double value, const physics::Network& network,
                  const Met& of_met, physics::Network& of_network) {
    double of_value = 0;
    if (at.opaque) {
        of_value += network.em_share[at.place] * of_met.opaque;
        of_network.em_share[at.place] += value * of_met.opaque;
    }
    if (at.supply) {
        of_value += network.ve_share[at.place] * of_met.supply;
        of_network.ve_share[at.place] += value * of_met.supply;
    }
    return at.windows ? of_value + of_met.windows : of_value;
}

}  // namespace

void RegimeBack::fixed(const physics::LinearForm& form, const Met& without_drivers,
                       double g, physics::LinearForm& of_form, Met& of_without_drivers) {
    pull_met(form, without_drivers, g, of_form, of_without_drivers);
    per_sol(form, -g * regime.network.phi_sky, of_form);
    of_network.phi_sky -= g * regime.per_sol(form);
}

void RegimeBack::per_theta_e(const Met& of_met) {
    of_network.em_share[0] += of_met.opaque;
    of_network.ve_share[0] += of_met.supply;
}

void RegimeBack::per_driver(int profile, const Met& of_met) {
    const physics::Building& building = regime.building;
    for (std::size_t k = 0; k < n_temperatures(regime.plan, building); ++k) {
        const physics::Input& theta = temperature(regime.plan, building, k);
        if (!follows(theta, profile)) continue;
        const double of_along =
            pull_added(entrance_of(building, k), along(theta, profile), regime.network,
                       of_met, of_network);
        pull_along(theta, profile, of_along,
                   temperature(regime.plan, place.of_building, k));
    }
}

void RegimeBack::without_drivers(const Met& of_met) {
    const physics::Building& building = regime.building;
    const std::vector<int>& drivers = regime.plan.temperature_drivers;
    for (std::size_t k = 0; k < n_temperatures(regime.plan, building); ++k) {
        const physics::Input& theta = temperature(regime.plan, building, k);
        const double of_value = pull_added(
            entrance_of(building, k), tabled(theta, drivers, regime.drive, regime.step()),
            regime.network, of_met, of_network);
        pull_tabled(theta, drivers, regime.drive, regime.step(), of_value,
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
