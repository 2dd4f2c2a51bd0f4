/// A [[study]] of kind "grid" as the job says it; what the meters show joins it when the
/// building is known.
#pragma once

#include "calibration/grid.hpp"
#include "calibration/target_simulator.hpp"

#include <string>
#include <vector>

namespace bemcal::job {

struct GridTargetSpec {
    calibration::OutputSpec output;  ///< of a building
    std::string simulator_output;    ///< of a [simulator], in place of it
    std::string meter;               ///< its name; "" = the first with the quantity
    std::vector<double> measured;    ///< in the output's unit; empty = from the meter
    double scale = 0;                ///< [%]; 0 = by rule
};

struct GridSpec {
    calibration::GridOptions options;     ///< without targets
    std::vector<GridTargetSpec> targets;  ///< empty = annual electricity and gas
};

/// The outputs that the targets are held against.
std::vector<calibration::OutputSpec> outputs_of(const GridSpec& spec);

/// Throw std::invalid_argument where a measured value is missing or zero, or an output or
/// meter is not there.
calibration::GridOptions options_for(const GridSpec& spec, const study::Case& building,
                                     const study::Period& period);
calibration::GridOptions options_for(const GridSpec& spec,
                                     const study::Simulator& simulator);

/// "air 5 x lights 6 = 30 points, then refined by itself up to 8000": for `check`.
std::string sentence_of(const calibration::GridOptions& options);

}  // namespace bemcal::job
