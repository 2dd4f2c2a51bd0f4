/// What `check` says of a stock: every building is read, none is simulated.
#pragma once

#include "plan/cost.hpp"

#include <string>

namespace bemcal::plan {

/// Lines that are broken with their reasons, findings, simulations, expected time.
std::string stock_plan_text(const job::Job& job, int cores);

/// The same in numbers, by the first building that can be read.
PlanCost stock_cost(const job::Job& job);

}  // namespace bemcal::plan
