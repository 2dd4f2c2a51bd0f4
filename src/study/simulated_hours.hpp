/// Hours that another program simulated, as meters would have read them.
#pragma once

#include "study/case.hpp"

#include <span>
#include <vector>

namespace bemcal::study {

/// Hours of all periods of the building, one after the other.
std::size_t hours_of_periods(const Case& building);

/// Which of the periods a program is run for. [periods] 1 = it is
using AskedPeriods = std::vector<char>;

std::vector<Period> periods_asked(const std::vector<Period>& periods,
                                  const AskedPeriods& asked);
double hours_asked(const std::vector<Period>& periods, const AskedPeriods& asked);

/// Of the hours of all periods those that were asked for.
std::vector<double> cut_to_asked(const std::vector<Period>& periods,
                                 const AskedPeriods& asked,
                                 const std::vector<double>& all);
/// And back, with NaN in periods that were not asked for. [hours of all periods]
std::vector<double> spread_asked(const std::vector<Period>& periods,
                                 const AskedPeriods& asked,
                                 const std::vector<double>& hours);

/// The part that is of a period. [hours]
std::vector<double> hours_in(const Case& building, const Period& period,
                             const std::vector<double>& all);

/// Hours summed (of a temperature their mean) over intervals that begin then. [intervals]
/// \param begins  of the hours
std::vector<double> over_intervals(const std::vector<physics::Seconds>& begins,
                                   std::span<const double> hours,
                                   const std::vector<physics::Seconds>& intervals,
                                   bool is_mean);

/// What a meter would have read in a period. [intervals of the period]
/// \param all  hours of all periods
std::vector<double> readings_of_hours(const Case& building, const Period& period,
                                      const kernel::Channel& meter,
                                      const std::vector<double>& all);

}  // namespace bemcal::study
