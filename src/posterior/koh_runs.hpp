/// A Kennedy-O'Hagan calibration whose simulator runs are still to be made: the first
/// round's items are runs, each a design of the calibrated inputs at a field point (paper
/// 1, eq. 2); the rounds after them are the chains.
///
/// A design with a run that failed is left out, so that the runs stay a full grid.
#pragma once

#include "posterior/koh_options.hpp"
#include "study/simulator.hpp"
#include "study/stage.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace bemcal::posterior {

/// What is to be run.
struct KohRuns {
    std::shared_ptr<const study::Simulator> simulator;
    std::size_t output = 0;         ///< of the simulator
    double factor = 1, offset = 0;  ///< on the output
    std::size_t n_designs = 100;    ///< scrambled Sobol points
    std::uint64_t seed = 0;
};

/// The parameters of those names, uniform in their ranges. Throws std::invalid_argument
/// for a name that is not a parameter's.
std::vector<study::Coordinate> simulator_coordinates(
    const study::Simulator& simulator, const std::vector<std::string>& names);

/// The options have measurements, names, priors of t and no runs. Parameters that are in
/// neither x nor t stay nominal. Throws std::invalid_argument for a name that is not a
/// parameter's.
std::unique_ptr<study::Stage> make_koh_stage_with_runs(std::string name,
                                                       KohOptions options,
                                                       const KohRuns& runs);

}  // namespace bemcal::posterior
