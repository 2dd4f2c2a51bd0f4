/// The way back from a step's map to the network: reverse-mode differentiation of
/// step_map.cpp by hand.
///
/// `of_x` is d objective / d x in the type of x: a StepMap of adjoints, a Network of
/// adjoints. Everything is added to.
#pragma once

#include "physics/step_map.hpp"

namespace bemcal::physics {

/// Of make_step_map: the forms after the step and theta_air.
void pull_step_map(const Network& network, double dt, const StepMap& of_map,
                   Network& of_network);

/// Of standard_step_map.
void pull_standard_step_map(const Network& network, double dt, const StepMap& of_map,
                            Network& of_network);

struct RadiantSplit;
/// Of radiant_split (hour.hpp).
void pull_radiant_split(const Network& network, const RadiantSplit& of_split,
                        Network& of_network);

}  // namespace bemcal::physics
