/// The validation of a meter, and what the data said of each unknown, as datasets.
#pragma once

#include "study/contraction.hpp"
#include "study/datasets.hpp"
#include "study/predictive.hpp"
#include "study/validation.hpp"

namespace bemcal::study {

/// One group for each part of the readings below `folder`. \param roles  [readings], or
/// empty
void add_validation(const MeterPrediction& meter, std::span<const Role> roles,
                    const std::string& folder, DatasetBuilder& datasets);

/// A row for each unknown, and an empty one for the log density.
void add_moves(const std::vector<ParameterMove>& moves, DatasetBuilder& datasets);

}  // namespace bemcal::study
