/// What retrofits would save: scenarios applied to every draw of a posterior, or to every
/// point that a screening or grid found best, each simulated before and after.
///
/// Draws give probabilities; best points give a range of what agrees with the readings.
/// The zones' mean air temperature says which occupied hours are too cold or too warm. A
/// residual of the calibrated model is in neither before nor after.
#pragma once

#include "retrofit/scenario.hpp"
#include "retrofit/setting.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::retrofit {

struct RetrofitOptions : Setting {
    std::vector<Scenario> scenarios;
};

std::unique_ptr<study::Stage> make_retrofit(std::string name, const study::Case& building,
                                            const study::Period& period,
                                            const RetrofitOptions& options);

/// Points of the case's parameters that the stage `of` found.
Matrix found_points(const std::vector<study::Summary>& found, const std::string& of,
                    const study::Case& building);

}  // namespace bemcal::retrofit
