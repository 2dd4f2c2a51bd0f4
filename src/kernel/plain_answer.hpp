/// What a batch answers, made from the plain simulation: for buildings that are not for
/// the kernel, and as the reference that the fast version is tested against.
#pragma once

#include "kernel/request.hpp"
#include "physics/drive.hpp"

namespace bemcal::kernel {

/// The answer for one building. Throws CannotSimulate as simulate() does.
PointAnswer plain_answer(const physics::Building& building, const physics::Drive& drive,
                         const Request& request);

/// Adds one pair to the sums; NaN readings are left out.
void compare_one(double simulated, double measured, ErrorSums& sums);

/// Adds the errors of a series against readings, at their interval and by month.
/// \param simulated  at the readings' intervals
void add_errors(const std::vector<double>& simulated, const physics::TimeAxis& period,
                const Readings& readings, PointAnswer& answer);

/// Whether errors are summed by month, too.
bool is_finer_than_month(physics::Interval interval);

/// Index of the calendar month, from 0, of every step of the period.
std::vector<int> month_of_steps(const physics::TimeAxis& period);

}  // namespace bemcal::kernel
