/// The number that is none.
#pragma once

#include <limits>

namespace bemcal {

/// A reading that is missing, a point that failed, a statistic that is not defined.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace bemcal
