/// What a posterior says of functions whose values it sampled.
#pragma once

#include "study/datasets.hpp"
#include "study/sampled_shapes.hpp"
#include "study/summary.hpp"

#include <vector>

namespace bemcal::posterior {

/// The values at each function's points: mean, 5 and 95 % quantile, in the layout of a
/// loop's functions. \param draws  of the case's parameters
void add_functions(const std::vector<study::SampledFunction>& functions,
                   const study::FoundPoints& draws, study::DatasetBuilder& datasets);

}  // namespace bemcal::posterior
