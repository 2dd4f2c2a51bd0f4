/// What the coefficients of one regime follow from, on the way there (affine.cpp) and on
/// the way back (affine_adjoint.cpp).
#pragma once

#include "physics/hour.hpp"
#include "physics/linear_input.hpp"
#include "physics/plan.hpp"

#include <utility>

namespace bemcal::physics {

/// Temperatures that a zone's forms meet beside the weather's: the boundaries', then what
/// outdoors differs by, as supply, behind opaque elements and at windows.
std::size_t n_temperatures(const ZonePlan& plan, const Building& building);
const Input& temperature(const ZonePlan& plan, const Building& building, std::size_t k);
inline Input& temperature(const ZonePlan& plan, Building& building, std::size_t k) {
    return const_cast<Input&>(temperature(plan, std::as_const(building), k));
}

/// Where one of them enters a form.
struct Entrance {
    std::size_t place;             ///< of the network's shares
    bool opaque, supply, windows;  ///< in theta_em, theta_sup, theta_e
};
Entrance entrance_of(const Building& building, std::size_t k);

struct Regime {
    const ZonePlan& plan;
    int index;
    const Building& building;
    const Zone& zone;
    const Drive& drive;
    const Network& network;
    RadiantSplit split;
    StepMap map;
    Control control;

    double per_radiant(const LinearForm& form) const {
        return split.to_st * form[Term::phi_st] + split.to_m * form[Term::phi_m];
    }
    /// Per gain of which a share heats the air at once.
    double per_gain(const LinearForm& form, double to_air) const {
        return to_air * form[Term::phi_ia] + (1 - to_air) * per_radiant(form);
    }
    double per_sol(const LinearForm& form) const {
        return per_gain(form, network.sun_air_share);
    }
    double per_int(const LinearForm& form) const {
        return per_gain(form, network.gains_air_share);
    }
    /// Per kelvin of the outdoor air.
    double per_theta_e(const LinearForm& form) const {
        return form[Term::theta_em] * network.em_share[0] +
               form[Term::theta_sup] * network.ve_share[0] + form[Term::theta_e];
    }
    double per_temperature(const LinearForm& form, const Entrance& at) const {
        double sum = 0;
        if (at.opaque) sum += form[Term::theta_em] * network.em_share[at.place];
        if (at.supply) sum += form[Term::theta_sup] * network.ve_share[at.place];
        if (at.windows) sum += form[Term::theta_e];
        return sum;
    }
    /// Per value of one of the temperature drivers.
    double per_driver(const LinearForm& form, int profile) const;
    /// What holds in a regime: temperatures without their drivers, and the loss to the
    /// sky.
    double fixed(const LinearForm& form) const;
    int step() const { return plan.regimes.first[static_cast<std::size_t>(index)]; }
};

/// The regime at the step in which it appears first. Throws as make_network, control_at.
/// \param network  scratch, written
Regime make_regime(const ZonePlan& plan, int index, const Building& building,
                   const Drive& drive, Network& network);

inline double span_of(const Input& input) {
    return input.value - input.low;
}

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
