/// The datasets of a grid: a group for each stage, and what the stages add up to.
#pragma once

#include "study/datasets.hpp"
#include "study/grid_rounds.hpp"

#include <string>
#include <vector>

namespace bemcal::study {

/// \param units  of the targets
std::vector<Dataset> grid_datasets(const std::string& name, const GridRounds& rounds,
                                   const std::vector<std::string>& units,
                                   const std::vector<Failure>& failures);

}  // namespace bemcal::study
