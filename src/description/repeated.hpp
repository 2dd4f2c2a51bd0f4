/// Readings that stand in two files of one meter or weather.
#pragma once

#include "description/timed_csv.hpp"

#include <span>

namespace bemcal::description {

/// Takes off `next`, the series of the last source, the steps that `series` (of those
/// before it) has already; a reading that is missing in one is taken from the other.
/// Throws UserError (data) that names both rows where they differ.
/// \return number of readings in both
int drop_repeated(input::RegularSeries& series, input::RegularSeries& next,
                  std::span<const TimedCsv> sources);

/// Throws UserError (data) that names the rows of the last source and of one before it
/// that give one time two readings.
/// \param of  what they are, for the message: "wind_speed is "
[[noreturn]] void refuse_two_readings(std::span<const TimedCsv> sources,
                                      const std::string& of, physics::Seconds begin,
                                      double before, double now);

}  // namespace bemcal::description
