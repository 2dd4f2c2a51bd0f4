/// A [[study]] of kind "grid" as the job says it; what the meters show joins it when the
/// building is known.
#pragma once

#include "job/targets.hpp"

namespace bemcal::job {

struct GridStudy {
    calibration::GridOptions options;  ///< without targets
    TargetSpecs targets;
    int n_runs = 0;  ///< of the [simulator]; 0 = one for each point
};

/// Throw std::invalid_argument where a measured value is missing or zero, or an output or
/// meter is not there.
calibration::GridOptions options_for(const GridStudy& grid, const study::Case& building,
                                     const study::Period& period);
calibration::GridOptions options_for(const GridStudy& grid,
                                     const study::Simulator& simulator);

}  // namespace bemcal::job
