/// What a meter's readings stand for, in a word.
#pragma once

#include <vector>

namespace bemcal::report {

/// The middle distance of begins that rise [s]; 0 of a single one.
double usual_interval(const std::vector<double>& begins);

/// "hourly", "monthly", ... by that distance; "billed" between other read dates.
const char* interval_name(const std::vector<double>& begins);

/// Whether readings are by the month or coarser, bills among them.
bool is_by_month(const std::vector<double>& begins);

}  // namespace bemcal::report
