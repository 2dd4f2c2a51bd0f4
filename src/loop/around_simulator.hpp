/// The loop around another program's model of a building. The program is calibrated by
/// runs; our own model of the same building, its twin, is fitted to the best of them, and
/// effects are sought in what that run leaves of the readings; what is found is given to
/// the program, which runs again. What is reported as before and after are the program's
/// own runs.
#pragma once

#include "loop/options.hpp"
#include "study/case.hpp"
#include "study/hourly_simulator.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>

namespace bemcal::loop {

/// The datasets stand under "BUILDING/name". `twin` must outlive the stage. Throws
/// std::invalid_argument where a meter that is learned from has no hours in the
/// simulator, or nothing is read in training.
std::unique_ptr<study::Stage> make_loop_around(
    std::string name, const study::Case& twin,
    std::shared_ptr<const study::HourlySimulator> simulator, LoopOptions options);

}  // namespace bemcal::loop
