/// Screening: a Sobol sample over the uncertain parameters, the error of every point
/// against every meter, and the points that meet ASHRAE Guideline 14.
#pragma once

#include "study/case.hpp"
#include "study/stage.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace bemcal::calibration {

struct ScreeningOptions {
    std::size_t n_points = 4096;
    std::size_t points_per_item = 1024;
    std::uint64_t seed = 0;
    bool keep_points = true;  ///< store every point with its errors, not the best only
    std::size_t n_best = 20;
    bool close_look = true;  ///< nominal and best are simulated again for their series
    /// Of nominal and best, stored by step.
    std::vector<physics::Quantity> hourly_outputs;
};

/// Point 0 is the nominal building, points 1 to n_points are a scrambled Sobol sample.
/// Every point is simulated over every period of the case. The best is chosen by the sum
/// over meters of the squared CV(RMSE) in the first period only; the others report.
/// Throws std::invalid_argument where no meter has a reading in the first period.
std::unique_ptr<study::Stage> make_screening(std::string name,
                                             const study::Case& building,
                                             const ScreeningOptions& options);

}  // namespace bemcal::calibration
