/// What a batch answers, made from the plain simulation: for buildings that are not for
/// the kernel, and as the reference that the fast version is tested against.
#pragma once

#include "physics/batch.hpp"

namespace bemcal::physics {

/// The answer for one building. Throws std::domain_error as simulate() does.
PointAnswer plain_answer(const Building& building, const Drive& drive,
                         const Request& request);

/// Adds one pair to the sums; NaN readings are left out.
void compare_one(double simulated, double measured, ErrorSums& sums);

/// Whether errors are summed by month, too.
bool is_finer_than_month(Interval interval);

/// Index of the calendar month, from 0, of every step of the period.
std::vector<int> month_of_steps(const TimeAxis& period);

/// The steps of the drive that are asked for.
TimeAxis period_of(const Drive& drive);

}  // namespace bemcal::physics
