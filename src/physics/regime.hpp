/// What the coefficients of one regime follow from, on the way there (affine.cpp) and on
/// the way back (affine_adjoint.cpp).
#pragma once

#include "physics/hour.hpp"
#include "physics/plan.hpp"

namespace bemcal::physics {

struct Regime {
    const ZonePlan& plan;
    const Building& building;
    const Zone& zone;
    const Drive& drive;
    const Network& network;
    RadiantSplit split;
    StepMap map;
    Control control;

    double per_sol(const LinearForm& form) const {
        return split.to_st * form[Term::phi_st] + split.to_m * form[Term::phi_m];
    }
    double per_int(const LinearForm& form) const {
        return 0.5 * (form[Term::phi_ia] + per_sol(form));
    }
    /// \param place  0 = outdoors behind elements and as supply, 1 + b = boundary b
    double per_temperature(const LinearForm& form, std::size_t place) const {
        return form[Term::theta_em] * network.em_share[place] +
               form[Term::theta_sup] * network.ve_share[place];
    }
    /// What does not change with time: constant boundaries, and the loss to the sky.
    double fixed(const LinearForm& form) const {
        double sum = -per_sol(form) * network.phi_sky;
        for (std::size_t b = 0; b < building.boundaries.size(); ++b) {
            const Input& theta = building.boundaries[b].temperature;
            sum += per_temperature(form, b + 1) *
                   (theta.profile < 0 ? theta.value : theta.low);
        }
        return sum;
    }
};

/// The regime at the step in which it appears first. Throws as make_network, control_at.
/// \param network  scratch, written
Regime make_regime(const ZonePlan& plan, int index, const Building& building,
                   const Drive& drive, Network& network);

inline double span_of(const Input& input) {
    return input.value - input.low;
}

/// Whether what a load brings to the zone is a driver.
bool is_driver(const ZonePlan& plan, const Input& density);

/// phi_int per value of a profile that is a driver [W].
double per_load_driver(const Regime& regime, int profile);

/// phi_int at a step, without the part that drivers bring [W].
double tabled_gain(const Regime& regime, int step);

/// What converts the standard hour's power into the change of the mass temperature it
/// causes.
struct StandardScale {
    double kelvin_per_watt;   ///< of the mass after the step
    double asked_per_kelvin;  ///< power, in those units, per kelvin of the air
    explicit StandardScale(const StepMap& map)
        : kelvin_per_watt(map.theta_m_after[Term::phi_h]),
          asked_per_kelvin(kelvin_per_watt / map.theta_air[Term::phi_h]) {}
};

/// The results of a step that a general zone's forms are: the air, and a state after it.
inline LinearForm& form_of(StepMap& map, Term state) {
    switch (state) {
        case Term::theta_m:
            return map.theta_m_after;
        case Term::theta_m2:
            return map.theta_m2_after;
        case Term::phi_emitter:
            return map.phi_emitter_after;
        default:
            return map.theta_air;
    }
}

inline const LinearForm& form_of(const StepMap& map, Term state) {
    return form_of(const_cast<StepMap&>(map), state);
}

/// The thermostat as a line in the air temperature (structure.hpp): asked - gain
/// theta_free.
struct Line {
    double asked = 0, gain = 0;
};
Line heating_line(const Regime& regime);
Line cooling_line(const Regime& regime);

}  // namespace bemcal::physics
