/// What is simulated and read by calendar month.
#pragma once

#include "study/case.hpp"

#include <span>
#include <vector>

namespace bemcal::loop {

/// Sums (means of a temperature) of the hours by calendar month, of those with a reading.
struct Months {
    std::vector<double> simulated, measured;
};

Months months_of(const std::vector<physics::Seconds>& begins,
                 std::span<const double> simulated, std::span<const double> measured,
                 bool is_mean);

/// The same of a meter that is not read by the hour: the hours of its intervals, then the
/// months of these.
Months read_by_month(const std::vector<physics::Seconds>& begins,
                     std::span<const double> simulated, const kernel::Readings& readings,
                     const physics::TimeAxis& axis);

}  // namespace bemcal::loop
