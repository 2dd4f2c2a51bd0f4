/// The random operators of NSGA-II on bounded variables.
#pragma once

#include "optimise/nsga2_options.hpp"
#include "optimise/optimiser.hpp"

#include <utility>

namespace bemcal::optimise {

/// Two children: simulated binary crossover, each variable with chance 1/2.
std::pair<Position, Position> cross(const Space& space, const Nsga2Options& options,
                                    const Position& mother, const Position& father,
                                    Stream& random);

/// Polynomial mutation, variable by variable.
Position mutated(const Space& space, const Nsga2Options& options, Position position,
                 Stream& random);

}  // namespace bemcal::optimise
