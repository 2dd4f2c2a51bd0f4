/// A meter over a period as it is stored, and how well a simulation fits it at the
/// meter's interval, by day and by month.
#pragma once

#include "stats/metrics.hpp"

#include <vector>

namespace bemcal::report {

struct FitSeries {
    std::vector<double> begins;  ///< of the intervals [s since 1970]
    std::vector<double> simulated, measured;
    bool is_mean = false;  ///< a temperature: days and months are means, not sums
};

double shortest_interval(const FitSeries& series);         ///< [s]; 0 of a single reading
const char* interval_name(const FitSeries& series);        ///< "hourly"
stats::Resolution resolution_of(const FitSeries& series);  ///< of Guideline 14

enum class Calendar { day, month };
/// Over the intervals of each day or month that have a reading.
stats::FitMetrics metrics_by(Calendar span, const FitSeries& series);

}  // namespace bemcal::report
