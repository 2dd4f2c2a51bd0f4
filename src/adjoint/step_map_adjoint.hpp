/// The way back from a step's map to the network: reverse-mode differentiation of
/// step_map.cpp by hand.
///
/// `of_x` is d objective / d x in the type of x: a StepMap of adjoints, a Network of
/// adjoints. Everything is added to.
#pragma once

#include "physics/hour.hpp"
#include "physics/step_map.hpp"

namespace bemcal::adjoint {

/// Of make_step_map: the forms after the step and theta_air.
void pull_step_map(const physics::Network& network, double dt,
                   const physics::StepMap& of_map, physics::Network& of_network);

/// Of standard_step_map.
void pull_standard_step_map(const physics::Network& network, double dt,
                            const physics::StepMap& of_map, physics::Network& of_network);

/// Of radiant_split (hour.hpp).
void pull_radiant_split(const physics::Network& network,
                        const physics::RadiantSplit& of_split,
                        physics::Network& of_network);

}  // namespace bemcal::adjoint
