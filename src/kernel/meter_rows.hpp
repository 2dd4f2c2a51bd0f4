/// Forms of a meter at many steps: where it has a row for every hour, one load or
/// efficiency is evaluated after another, not one step after another.
#pragma once

#include "base/lane_array.hpp"
#include "kernel/plan.hpp"

namespace bemcal::kernel {

/// Writes a lane of the meter's rows [3 n_rows x lanes]: meter_form at the first step of
/// each, to the bit. Throws CannotSimulate as meter_form does.
void write_meter_rows(const MeterPlan& plan, const physics::Building& building,
                      const physics::Drive& drive, physics::Quantity quantity, int lane,
                      LaneArray& rows);

}  // namespace bemcal::kernel
