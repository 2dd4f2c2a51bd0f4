/// What the coefficients of one regime follow from, on the way there (affine.cpp) and on
/// the way back (affine_adjoint.cpp).
#pragma once

#include "kernel/linear_input.hpp"
#include "kernel/plan.hpp"
#include "physics/hour.hpp"

#include <utility>

namespace bemcal::kernel {

/// Temperatures that a zone's forms meet beside the weather's: the boundaries', then what
/// outdoors differs by, as supply, behind opaque elements and at windows.
std::size_t n_temperatures(const ZonePlan& plan, const physics::Building& building);
const physics::Input& temperature(const ZonePlan& plan, const physics::Building& building,
                                  std::size_t k);
inline physics::Input& temperature(const ZonePlan& plan, physics::Building& building,
                                   std::size_t k) {
    return const_cast<physics::Input&>(temperature(plan, std::as_const(building), k));
}

/// Where one of them enters a form.
struct Entrance {
    std::size_t place;             ///< of the network's shares
    bool opaque, supply, windows;  ///< in theta_em, theta_sup, theta_e
};
Entrance entrance_of(const physics::Building& building, std::size_t k);

/// What a form meets at the zone's three temperatures: theta_em, theta_sup, theta_e.
struct Met {
    double opaque = 0, supply = 0, windows = 0;

    /// What a temperature brings where it enters.
    void add(const Entrance& at, double value, const physics::Network& network) {
        if (at.opaque) opaque += network.em_share[at.place] * value;
        if (at.supply) supply += network.ve_share[at.place] * value;
        if (at.windows) windows += value;
    }
    double by(const physics::LinearForm& form) const {
        return form[physics::Term::theta_em] * opaque +
               form[physics::Term::theta_sup] * supply +
               form[physics::Term::theta_e] * windows;
    }
};

struct Regime {
    const ZonePlan& plan;
    int index;
    const physics::Building& building;
    const physics::Zone& zone;
    const physics::Drive& drive;
    const physics::Network& network;
    physics::RadiantSplit split;
    physics::StepMap map;
    physics::Control control;

    double per_radiant(const physics::LinearForm& form) const {
        return split.to_st * form[physics::Term::phi_st] +
               split.to_m * form[physics::Term::phi_m];
    }
    /// Per gain of which a share heats the air at once.
    double per_gain(const physics::LinearForm& form, double to_air) const {
        return to_air * form[physics::Term::phi_ia] + (1 - to_air) * per_radiant(form);
    }
    double per_sol(const physics::LinearForm& form) const {
        return per_gain(form, network.sun_air_share);
    }
    double per_int(const physics::LinearForm& form) const {
        return per_gain(form, network.gains_air_share);
    }
    /// Per kelvin of the outdoor air.
    Met per_theta_e() const { return {network.em_share[0], network.ve_share[0], 1}; }
    /// Per value of one of the temperature drivers.
    Met per_driver(int profile) const;
    /// Temperatures without their drivers [degC].
    Met without_drivers() const;
    /// What holds in a regime: these, and the loss to the sky.
    double fixed(const physics::LinearForm& form, const Met& without_drivers) const {
        return without_drivers.by(form) - per_sol(form) * network.phi_sky;
    }
    int step() const { return plan.regimes.first[static_cast<std::size_t>(index)]; }
};

/// The regime at the step in which it appears first. The regimes of a building are made
/// in their order, from 0, each with the network of the one before. Throws as
/// make_network, control_at, and CannotSimulate where a season's limit is beyond what the
/// plan is for.
Regime make_regime(const ZonePlan& plan, int index, const physics::Building& building,
                   const physics::Drive& drive, physics::Network& network,
                   physics::StepMaps& maps);

inline double span_of(const physics::Input& input) {
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
    explicit StandardScale(const physics::StepMap& map)
        : kelvin_per_watt(map.theta_m_after[physics::Term::phi_h]),
          asked_per_kelvin(kelvin_per_watt / map.theta_air[physics::Term::phi_h]) {}
};

/// The results of a step that a general zone's forms are: the air, and a state after it.
inline physics::LinearForm& form_of(physics::StepMap& map, physics::Term state) {
    switch (state) {
        case physics::Term::theta_m:
            return map.theta_m_after;
        case physics::Term::theta_m2:
            return map.theta_m2_after;
        case physics::Term::phi_emitter:
            return map.phi_emitter_after;
        default:
            return map.theta_air;
    }
}

inline const physics::LinearForm& form_of(const physics::StepMap& map,
                                          physics::Term state) {
    return form_of(const_cast<physics::StepMap&>(map), state);
}

/// The thermostat as a line in the air temperature (structure.hpp): asked - gain
/// theta_free.
struct Line {
    double asked = 0, gain = 0;
};
/// Of all rooms, whatever the season.
Line heating_line(const Regime& regime);
Line cooling_line(const Regime& regime);

}  // namespace bemcal::kernel
