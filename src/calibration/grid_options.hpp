/// What a grid (grid.hpp) is given: values, targets, and when it ends.
#pragma once

#include "stats/nearest.hpp"

#include <string>
#include <utility>
#include <vector>

namespace bemcal::calibration {

struct GridTarget {
    std::string output;   ///< of the simulator
    double measured = 0;  ///< in the output's unit; not 0
    double scale = 0;  ///< scaled distance: the error that counts as 1 [%]; 0 = by rule
};

enum class GridDistance {
    euclidean,  ///< of the errors in per cent
    scaled      ///< of the errors over their scales; by rule a scale is the standard
                ///< deviation of the target's errors over the first stage's grid
};

/// Values of some parameters by name; the others stay nominal.
using NamedGrid = std::vector<std::pair<std::string, std::vector<double>>>;

struct GridOptions {
    std::vector<NamedGrid> grids;  ///< of the first stages, one at least; then refined
    std::vector<GridTarget> targets;
    GridDistance distance = GridDistance::euclidean;
    stats::NearestOptions nearest;
    double target_error = 0;        ///< [%] Euclidean, of the nearest; there it ends
    int most_stages = 10;           ///< those given included
    long long budget = 100000;      ///< points of all stages together
    double index_threshold = 0.05;  ///< total order above which a parameter matters
    std::size_t points_per_item = 128;
    std::vector<std::string> discrete;  ///< parameters that get no midpoints
};

}  // namespace bemcal::calibration
