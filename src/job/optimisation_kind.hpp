/// A [[study]] of kind "optimisation" as the job says it.
#pragma once

#include "calibration/optimisation.hpp"
#include "job/targets.hpp"

namespace bemcal::job {

struct OptimisationStudy {
    calibration::OptimisationOptions options;
    TargetSpecs targets;  ///< empty = it fits meters
    int n_runs = 0;       ///< of the [simulator]; 0 = one for each point
};

}  // namespace bemcal::job
