/// The datasets of a grid: a group for each stage, and what the stages add up to.
#pragma once

#include "calibration/grid_rounds.hpp"
#include "study/datasets.hpp"

#include <string>
#include <vector>

namespace bemcal::calibration {

/// \param units  of the targets
std::vector<study::Dataset> grid_datasets(const std::string& name,
                                          const GridRounds& rounds,
                                          const std::vector<std::string>& units,
                                          const std::vector<study::Failure>& failures);

}  // namespace bemcal::calibration
