/// The residual model's parameters by name and, for a few points, by lane. Internal to
/// the residual model.
#pragma once

#include "stats/residual_model_lanes.hpp"
#include "stats/residual_model_options.hpp"

#include <array>
#include <vector>

namespace bemcal::stats::residual {

enum Parameter : std::size_t { constant, proportional, phi, share, timescale };

/// Those that the options have, in the order of the caller's rows.
std::vector<Parameter> parameters_of(const ResidualOptions& options);

/// Those that the options leave out stay at values without effect.
using ParameterLanes = std::array<Lanes, 5>;
inline ParameterLanes no_effect() {
    return {all(0), all(0), all(0), all(0), all(1)};
}

/// phi in [0, 1), share in [0, 1], timescale above 0.
Eigen::Array<bool, width, 1> are_in_range(const ParameterLanes& parameters);

}  // namespace bemcal::stats::residual
