/// One step of a zone as an affine map, refinements included: what structure.cpp
/// evaluates and what the fast kernel takes its coefficients from.
///
/// Every result of a step is linear in twelve terms: the state before, the step's
/// temperatures and gains, and the powers that are asked of heating and cooling. The
/// thermostat only chooses the last two. Nodes as in ISO 13790 Annex C (air, surface,
/// mass) with, where they are on, the air capacity (implicit Euler), the emitter (exact)
/// and the second mass (Crank-Nicolson).
#pragma once

#include "physics/linear_form.hpp"
#include "physics/network.hpp"

#include <array>

namespace bemcal::physics {

/// Results of a step. Means of the step unless `_after`, which are at its end. The air
/// state after the step is theta_air itself (implicit Euler).
struct StepMap {
    LinearForm theta_m_after, theta_m2_after, phi_emitter_after;
    LinearForm theta_m, theta_s, theta_air;
};

/// \param dt  [s]
StepMap make_step_map(const Network& network, double dt);

/// Makes maps one after the other, all of one step: of buildings beside each other most
/// numbers that a map follows from are the same, and then so is the map.
class StepMaps {
  public:
    const StepMap& of(const Network& network, double dt);

  private:
    struct Known {
        std::array<double, 14> numbers{};  ///< of its network; all 0: none yet
        StepMap map;
    };
    static constexpr std::size_t most_known = 8;  ///< one for each lane of the kernel
    std::array<Known, most_known> known_{};
    std::size_t last_ = 0;  ///< of them
};

/// Of the same forms the two that the standard hour needs (theta_m_after, theta_air) at
/// the terms that it has, from C.4 to C.11 written out: a twentieth of the work.
StepMap standard_step_map(const Network& network, double dt);

}  // namespace bemcal::physics
