/// Schedules as they would be on another day or at another hour.
#pragma once

#include "effects/surroundings.hpp"

#include <span>

namespace bemcal::effects {

/// Whether a row of Drive::profiles repeats from week to week, as schedules do and
/// measured series do not: equal to the week before at 70 % of its steps.
bool is_schedule(std::span<const double> row, const physics::Drive& drive);

/// The row as on `weekday` (0 = Monday) at the same hour [n_steps]: of the nine nearest
/// days of that weekday in the period the pattern that is there most often, so that
/// closed days are passed over and seasons are followed.
std::vector<double> as_on(int weekday, std::span<const double> row,
                          const physics::Drive& drive);

/// The row as if its hours came `hours` later [n_steps]; between steps linear.
std::vector<double> later_by(double hours, std::span<const double> row,
                             const physics::Drive& drive);

}  // namespace bemcal::effects
