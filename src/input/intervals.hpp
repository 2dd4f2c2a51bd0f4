/// Readings on the intervals of a meter: finer ones summed by calendar. A reading stands
/// at the first step of its interval; all other steps are NaN.
#pragma once

#include "input/series.hpp"
#include "physics/meters.hpp"

namespace bemcal::input {

/// What rows at this distance are: steps below an hour, hours, days (and odd hours),
/// calendar months, years.
physics::Interval interval_of_rows(int step_s);

/// The begin of the calendar's interval with `time`, and of the one after it. Not for
/// `step`.
physics::Seconds interval_begin(physics::Seconds time, physics::Interval interval);
physics::Seconds next_interval(physics::Seconds begin, physics::Interval interval);

/// Sums (or means) of whole intervals, on an hourly axis; one that is cut off or has a
/// missing value is missing.
RegularSeries sum_intervals(const RegularSeries& fine, physics::Interval interval,
                            bool mean);

/// The begins of the intervals of such an axis, and the end of the last one.
std::vector<physics::Seconds> bounds_of(const physics::TimeAxis& hours,
                                        physics::Interval interval);

}  // namespace bemcal::input
