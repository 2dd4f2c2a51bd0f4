/// Words what was read of a building's meters, so that a user sees whether it is what the
/// file says: sums, the largest reading, how many there are.
#pragma once

#include "study/case.hpp"

#include <string>

namespace bemcal::plan {

/// A line for each meter, and one for each of its periods that has readings.
std::string meter_lines(const study::Case& building);

}  // namespace bemcal::plan
