/// Whether two series are one: identical, or one a fixed share of the other, in nearly
/// all their readings.
#pragma once

#include <span>

namespace bemcal::checks {

struct Proportion {
    int n = 0;         ///< readings that both have, above 0 and fine enough to tell
    double ratio = 0;  ///< second / first
    double share = 0;  ///< of n: equal by the ratio, within rounding and 0.1 %
};
/// n is 0 with fewer than 168 such readings, or where the first one hardly varies.
Proportion proportion_of(std::span<const double> first, std::span<const double> second);

}  // namespace bemcal::checks
