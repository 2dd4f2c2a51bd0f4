/// How a screening (screening.hpp) is done, and what it stores.
#pragma once

#include "physics/meters.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bemcal::calibration {

struct ScreeningOptions {
    std::size_t n_points = 4096;
    std::size_t points_per_item = 1024;
    std::uint64_t seed = 0;
    bool keep_points = true;  ///< store every point with its errors, not the best only
    std::size_t n_best = 20;
    int simulator_runs = 80;  ///< of another program, where there is one
    bool close_look = true;   ///< nominal and best are simulated again for their series
    /// Of nominal and best, stored by step.
    std::vector<physics::Quantity> hourly_outputs;
};

}  // namespace bemcal::calibration
