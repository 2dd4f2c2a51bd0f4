/// A study of a slow simulator by few runs of it: an emulator of its outputs, learned
/// from these runs, answers the study's points.
#pragma once

#include "study/simulator.hpp"
#include "study/stage.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace bemcal::study {

/// Makes a study of a simulator.
using StudyOf = std::function<std::unique_ptr<Stage>(std::shared_ptr<const Simulator>)>;

/// Twice as many as tell slopes of all parameters: a half is left to tell curves, and to
/// fail.
int least_runs_of_study(std::size_t n_parameters);

/// First the runs, at Sobol points of the parameters' ranges, then the study. Both have
/// the same name. Throws std::invalid_argument where the runs are too few for the
/// parameters.
std::unique_ptr<Stage> make_emulated_study(std::string name,
                                           std::shared_ptr<const Simulator> simulator,
                                           int n_runs, std::uint64_t seed, StudyOf study);

}  // namespace bemcal::study
