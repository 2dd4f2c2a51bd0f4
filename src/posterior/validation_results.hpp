/// The validation of a meter, and what the data said of each unknown, as datasets.
#pragma once

#include "posterior/contraction.hpp"
#include "posterior/predictive.hpp"
#include "study/datasets.hpp"
#include "study/validation.hpp"

namespace bemcal::posterior {

/// One group for each part of the readings below `folder`. \param roles  [readings], or
/// empty. \return the parts
std::vector<study::PartValidation> add_validation(const MeterPrediction& meter,
                                                  std::span<const study::Role> roles,
                                                  const std::string& folder,
                                                  study::DatasetBuilder& datasets);

/// A row for each unknown, and an empty one for the log density.
void add_moves(const std::vector<ParameterMove>& moves, study::DatasetBuilder& datasets);

}  // namespace bemcal::posterior
