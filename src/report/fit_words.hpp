/// How tables of fits word what changed: errors, limits met, intervals.
#pragma once

#include <string>
#include <vector>

namespace bemcal::report {

/// "hourly", "monthly", ... by the distance of the first two intervals [s]; "once" where
/// there is but one.
const char* interval_name(const std::vector<double>& begins);

/// "12.3 -> 4.5", in per cent of shares; NaN as "-".
std::string change(double before, double after);

/// "no -> yes": whether limits are met.
std::string verdict(bool before, bool after);

}  // namespace bemcal::report
