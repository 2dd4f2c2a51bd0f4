/// What a study concludes as an item's numbers, so that an item may answer with a whole
/// study.
#pragma once

#include "study/stage.hpp"

#include <span>

namespace bemcal::study {

std::vector<double> pack(const Conclusion& conclusion);
Conclusion unpack_conclusion(std::span<const double> packed);

}  // namespace bemcal::study
