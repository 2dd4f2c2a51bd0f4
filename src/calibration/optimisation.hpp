/// Optimisation: the parameters that fit a building's meters best, by evaluations in
/// rounds over ranks.
///
/// With one objective, paper 2's f = 0.7 CV(RMSD) + 0.3 (1 - R2) by default, a method of
/// optimise/methods.hpp; with the error of each meter as an objective NSGA-II, as the
/// comparison in paper 3 has it. Instead of meters it may aim at single numbers, as a
/// grid does: of a building, or of another program.
#pragma once

#include "calibration/optimisation_options.hpp"
#include "study/case.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>

namespace bemcal::calibration {

/// Throws std::invalid_argument for a meter or parameter that is not there, weights of
/// another number than the meters, no reading in the period, an odd population.
std::unique_ptr<study::Stage> make_optimisation(std::string name,
                                                const study::Case& building,
                                                const OptimisationOptions& options);

/// The same for targets: one objective is the distance to them [%]. Throws
/// std::invalid_argument for a target or parameter that is not there, and a target of 0.
std::unique_ptr<study::Stage> make_optimisation(std::string name, const TargetAim& aim,
                                                const OptimisationOptions& options);

}  // namespace bemcal::calibration
