/// What retrofits would save: scenarios applied to every draw of a posterior, or to every
/// point that a screening or grid found best, each simulated before and after.
///
/// Draws give probabilities; best points give a range of what agrees with the readings.
/// The zones' mean air temperature says which occupied hours are too cold or too warm. A
/// residual of the calibrated model is in neither before nor after.
#pragma once

#include "retrofit/scenario.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::retrofit {

struct RetrofitOptions {
    std::vector<Scenario> scenarios;
    std::string of;             ///< name of the stage whose points are taken
    int n_points = 200;         ///< at most, evenly spread
    int occupied_profile = -1;  ///< of the case; an hour counts from 0.5 on; -1 = all
    double too_cold = 19;       ///< [degC] below it
    double too_warm = 26;       ///< [degC] above it
};

std::unique_ptr<study::Stage> make_retrofit(std::string name, const study::Case& building,
                                            const study::Period& period,
                                            const RetrofitOptions& options);

/// Points of the case's parameters that the stage `of` found: all draws of a posterior,
/// or the best points of a screening or grid, best first. Parameters that were not
/// calibrated are nominal. [0 x parameters] where there are none.
Matrix found_points(const std::vector<study::Summary>& found, const std::string& of,
                    const study::Case& building);

}  // namespace bemcal::retrofit
