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
    void per_theta_e(const physics::LinearForm& form, double g,
                     physics::LinearForm& of_form);
    void per_temperature(const physics::LinearForm& form, const Entrance& at, double g,
                         physics::LinearForm& of_form);
    void per_driver(const physics::LinearForm& form, int profile, double g,
                    physics::LinearForm& of_form);
    void fixed(const physics::LinearForm& form, double g, physics::LinearForm& of_form);
};

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
    each([&](const physics::LinearForm& form) { return regime.per_theta_e(form); },
         [&](const physics::LinearForm& form, double g, physics::LinearForm& of_form) {
             back.per_theta_e(form, g, of_form);
         });
    for (int profile : regime.plan.temperature_drivers)
        each(
            [&](const physics::LinearForm& form) {
                return regime.per_driver(form, profile);
            },
            [&](const physics::LinearForm& form, double g, physics::LinearForm& of_form) {
                back.per_driver(form, profile, g, of_form);
            });
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
