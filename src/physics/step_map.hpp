/// One step of a zone as an affine map, refinements included: what structure.cpp
/// evaluates and what the fast kernel takes its coefficients from.
///
/// Every result of a step is linear in twelve terms: the state before, the step's
/// temperatures and gains, and the powers that are asked of heating and cooling. The
/// thermostat only chooses the last two. Nodes as in ISO 13790 Annex C (air, surface,
/// mass) with, where they are on, the air capacity (implicit Euler), the emitter (exact)
/// and the second mass (Crank-Nicolson).
#pragma once

#include "physics/network.hpp"

#include <array>
#include <cstddef>

namespace bemcal::physics {

/// What a step starts from.
enum class Term {
    theta_m,      ///< state: mass [degC]
    theta_m2,     ///< state: second mass [degC]
    theta_air,    ///< state: air [degC]; its coefficients are 0 without an air capacity
    phi_emitter,  ///< state: heat leaving the emitter [W]; 0 without a lag
    theta_em,     ///< behind the opaque elements [degC]
    theta_e,      ///< at windows [degC]
    theta_sup,    ///< supply air [degC]
    phi_ia,
    phi_st,
    phi_m,  ///< gains of the nodes [W]
    phi_h,  ///< asked of heating [W]; through lag and radiant share
    phi_c,  ///< asked of cooling [W], >= 0; taken from the air node at once
};
constexpr std::size_t n_terms = 12;

/// Values of the terms at one step.
struct TermValues {
    std::array<double, n_terms> value{};
    double& operator[](Term term) { return value[static_cast<std::size_t>(term)]; }
    double operator[](Term term) const { return value[static_cast<std::size_t>(term)]; }
};

/// A quantity as a weighted sum of the terms.
struct LinearForm {
    std::array<double, n_terms> weight{};
    double& operator[](Term term) { return weight[static_cast<std::size_t>(term)]; }
    double operator[](Term term) const { return weight[static_cast<std::size_t>(term)]; }
    double at(const TermValues& terms) const;  ///< summed in the order of the terms
};

/// Results of a step. Means of the step unless `_after`, which are at its end. The air
/// state after the step is theta_air itself (implicit Euler).
struct StepMap {
    LinearForm theta_m_after, theta_m2_after, phi_emitter_after;
    LinearForm theta_m, theta_s, theta_air;
    LinearForm phi_delivered;  ///< mean heat that leaves the emitter [W]
};

/// \param dt  [s]
StepMap make_step_map(const Network& network, double dt);

/// Of the same forms the two that the standard hour needs (theta_m_after, theta_air) at
/// the terms that it has, from C.4 to C.11 written out: a twentieth of the work.
StepMap standard_step_map(const Network& network, double dt);

}  // namespace bemcal::physics
