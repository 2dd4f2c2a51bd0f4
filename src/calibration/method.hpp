/// The optimiser's method that the options of an optimisation, or of a stage, ask for.
#pragma once

#include "calibration/optimisation_options.hpp"
#include "optimise/optimiser.hpp"

#include <cstdint>

namespace bemcal::calibration {

/// \param stream  of the seed: each use has random numbers of its own
optimise::Method method_of(const OptimisationOptions& options, std::uint32_t stream);

}  // namespace bemcal::calibration
