/// Datasets as an item's numbers, so that an item may answer with its whole result.
#pragma once

#include "study/stage.hpp"

#include <span>

namespace bemcal::study {

std::vector<double> pack(const std::vector<Dataset>& datasets);
std::vector<Dataset> unpack(std::span<const double> packed);

}  // namespace bemcal::study
