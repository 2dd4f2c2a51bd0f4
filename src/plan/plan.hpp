/// What a job will cost, in words: for `check`.
#pragma once

#include "plan/cost.hpp"

#include <string>

namespace bemcal::plan {

/// Of a job, or of a stock as far as it can be told.
PlanCost plan_cost(const job::Job& job);

/// Items, simulations, memory, output size and expected time of every stage on that many
/// cores, and what was found in the data.
std::string plan_text(const job::Job& job, int cores);

}  // namespace bemcal::plan
