/// How a meter's readings may change without a name: patterns of its days.
#pragma once

#include "stock/day_sums.hpp"

#include <string>
#include <vector>

namespace bemcal::stock {

struct Pattern {
    std::string name;  ///< "gas: by a share", "gas: 0 to 6 h"
    std::string unit;  ///< of its coefficient
    Matrix values;     ///< [days x features] what a unit of it adds
};

/// Of each meter: a share of what is foretold, a level of all hours, of a quarter of the
/// day, of workdays and of weekends.
std::vector<Pattern> meter_patterns(const study::Case& building, const DaySums& sums);

}  // namespace bemcal::stock
