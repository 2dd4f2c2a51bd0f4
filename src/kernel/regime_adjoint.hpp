/// The way back from a regime's linear forms and gains to the building: what
/// affine_adjoint.cpp needs for its columns.
#pragma once

#include "adjoint/network_adjoint.hpp"
#include "kernel/regime.hpp"

namespace bemcal::kernel {

/// A regime with the adjoints of what it is made of. The functions add the adjoint g of
/// the regime's function of the same name to the form's and to the others.
struct RegimeBack {
    const Regime& regime;
    adjoint::PlaceBack place;
    physics::Network& of_network;
    physics::StepMap of_map{};
    physics::RadiantSplit of_split{0, 0};
    physics::Control of_control{0, 0, 0, 0, false, 0, 0, 0};

    void per_radiant(const physics::LinearForm& form, double g,
                     physics::LinearForm& of_form);
    void per_gain(const physics::LinearForm& form, double to_air, double g,
                  physics::LinearForm& of_form, double& of_to_air);
    void per_sol(const physics::LinearForm& form, double g, physics::LinearForm& of_form);
    void per_int(const physics::LinearForm& form, double g, physics::LinearForm& of_form);
    void fixed(const physics::LinearForm& form, const Met& without_drivers, double g,
               physics::LinearForm& of_form, Met& of_without_drivers);
    void per_theta_e(const Met& of_met);
    void per_driver(int profile, const Met& of_met);
    void without_drivers(const Met& of_met);
};

/// Of Met::by.
inline void pull_met(const physics::LinearForm& form, const Met& met, double g,
                     physics::LinearForm& of_form, Met& of_met) {
    of_form[physics::Term::theta_em] += g * met.opaque;
    of_form[physics::Term::theta_sup] += g * met.supply;
    of_form[physics::Term::theta_e] += g * met.windows;
    of_met.opaque += g * form[physics::Term::theta_em];
    of_met.supply += g * form[physics::Term::theta_sup];
    of_met.windows += g * form[physics::Term::theta_e];
}

/// Of value - low.
inline void pull_span(double of_span, physics::Input& of_input) {
    of_input.value += of_span;
    of_input.low -= of_span;
}

/// Of per_load_driver and tabled_gain (regime.hpp).
void pull_load_driver(RegimeBack& back, int profile, double of_gain);
void pull_tabled_gain(RegimeBack& back, int step, double of_gain);

/// Calls each(weight of a form per value of the driver, its way back) for every driver
/// but an imposed power, as for_drivers of affine.cpp.
template <class Each>
void for_drivers(RegimeBack& back, Each each) {
    const Regime& regime = back.regime;
    const auto of_each = [&](const Met& met) {
        Met of_met;
        each(
            [&](const physics::LinearForm& form) { return met.by(form); },
            [&](const physics::LinearForm& form, double g, physics::LinearForm& of_form) {
                pull_met(form, met, g, of_form, of_met);
            });
        return of_met;
    };
    back.per_theta_e(of_each(regime.per_theta_e()));
    for (int profile : regime.plan.temperature_drivers)
        back.per_driver(profile, of_each(regime.per_driver(profile)));
    for (int profile : regime.plan.load_drivers) {
        const double gain = per_load_driver(regime, profile);
        double of_gain = 0;
        each(
            [&](const physics::LinearForm& form) { return gain * regime.per_int(form); },
            [&](const physics::LinearForm& form, double g, physics::LinearForm& of_form) {
                back.per_int(form, g * gain, of_form);
                of_gain += g * regime.per_int(form);
            });
        pull_load_driver(back, profile, of_gain);
    }
}

}  // namespace bemcal::kernel
