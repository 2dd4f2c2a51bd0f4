/// The posterior of another program's model of a building, from some dozen of its runs:
/// rounds of runs, then chains on an emulator of the readings (emulated_meters.hpp).
#pragma once

#include "posterior/posterior_options.hpp"
#include "study/case.hpp"
#include "study/hourly_simulator.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>

namespace bemcal::posterior {

/// Of the building its meters and periods count, and nothing else; of the options
/// `parameters` are the program's, those left out stay nominal. Throws
/// std::invalid_argument where a meter that is learned from has no hours in the
/// simulator, or nothing is read in training.
std::unique_ptr<study::Stage> make_simulator_posterior(
    std::string name, const study::Case& building,
    std::shared_ptr<const study::HourlySimulator> simulator,
    const PosteriorOptions& options);

}  // namespace bemcal::posterior
