/// Readings on the intervals of a meter: finer ones summed, monthly and annual ones by
/// calendar. A reading stands at the first step of its interval; all other steps are NaN.
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

/// Monthly or annual rows on an hourly axis. Throws UserError (data) where a row does not
/// begin with its month or year (within 36 h), or two fall into the same.
RegularSeries calendar_rows(const Csv& csv, const Stamps& stamps,
                            const std::vector<double>& values, physics::Interval interval,
                            bool stamps_at_end);

}  // namespace bemcal::input
