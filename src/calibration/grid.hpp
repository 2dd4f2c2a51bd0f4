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

#include "calibration/grid_options.hpp"
#include "study/simulator.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::calibration {

/// Throws std::invalid_argument where a name is unknown, a grid is empty, an output is no
/// target's or a target is 0, or a given grid is larger than the budget.
std::unique_ptr<study::Stage> make_grid(std::string name,
                                        std::shared_ptr<const study::Simulator> simulator,
                                        const GridOptions& options);

}  // namespace bemcal::calibration
