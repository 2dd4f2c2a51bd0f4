/// The periods that a program is to simulate, as a file that it reads.
#pragma once

#include "study/case.hpp"

#include <span>
#include <string>

namespace bemcal::external {

/// CSV: a header, then name, first and last day of each period.
std::string text_of_periods(std::span<const study::Period> periods);

}  // namespace bemcal::external
