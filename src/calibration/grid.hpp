/// A grid in stages: every combination of given values is simulated and held against a
/// reference point; the k nearest with density avoidance say which values survive, and
/// the next stage's grid is refined around those (Basurra and Jankovic's k-NN calibration
/// of a semi-detached house).
///
/// The reference point is any set of outputs with a measured value each; the errors are
/// in per cent of it. After a stage a parameter that keeps one value is fixed there. One
/// value can mean two things, which the total-order Sobol index over the stage's own grid
/// tells apart: the parameter does not matter (insensitive), or it matters so much that
/// only one value fits (determined). Where a stage comes hardly nearer than the one
/// before, determined parameters are set free again, with the midpoints around the value.
#pragma once

#include "calibration/grid_axes.hpp"
#include "stats/nearest.hpp"
#include "study/simulator.hpp"
#include "study/stage.hpp"

#include <memory>
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

/// Throws std::invalid_argument where a name is unknown, a grid is empty, an output is no
/// target's or a target is 0, or a given grid is larger than the budget.
std::unique_ptr<study::Stage> make_grid(std::string name,
                                        std::shared_ptr<const study::Simulator> simulator,
                                        const GridOptions& options);

/// Every parameter of the simulator with its values: those given, else the nominal one.
Grid grid_of(const std::vector<physics::Parameter>& parameters, const NamedGrid& named);

}  // namespace bemcal::calibration
