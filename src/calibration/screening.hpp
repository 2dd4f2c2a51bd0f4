/// Screening: a Sobol sample over the uncertain parameters, the error of every point
/// against every meter, and the points that meet ASHRAE Guideline 14.
#pragma once

#include "calibration/period_model.hpp"
#include "calibration/screening_options.hpp"
#include "study/case.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>

namespace bemcal::calibration {

/// Point 0 is the nominal building, points 1 to n_points are a scrambled Sobol sample.
/// Every point is simulated over every period of the case. The best is chosen by the sum
/// over meters of the squared CV(RMSE) in the first period only; the others report.
/// Throws std::invalid_argument where no meter has a reading in the first period.
std::unique_ptr<study::Stage> make_screening(
    std::string name, const study::Case& building, const ScreeningOptions& options,
    const MakePeriodModel& model = own_period_model);

}  // namespace bemcal::calibration
