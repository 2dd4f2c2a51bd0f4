/// The loop: a calibrated model's residual is traced to effects that the description
/// lacks, which join the model one by one as long as they predict better what was kept
/// from them.
#pragma once

#include "loop/options.hpp"
#include "study/case.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::loop {

/// Simulations that the search in one building takes, about.
inline constexpr long long usual_simulations = 20000;

/// A building is an item; it is searched in training, and its other periods are read for
/// the errors that are reported only (but the job's data checks, which correct units and
/// mask readings, have looked at a meter's whole series before). The datasets of a
/// building stand under its name, then the stage's. Throws std::invalid_argument where a
/// building has nothing to learn from.
std::unique_ptr<study::Stage> make_loop(std::string name,
                                        const std::vector<study::Case>& buildings,
                                        const LoopOptions& options);

}  // namespace bemcal::loop
