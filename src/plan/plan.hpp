/// What a job will cost, in words: for `check`.
#pragma once

#include "job/job.hpp"

#include <string>

namespace bemcal::plan {

/// Of all stages together.
struct PlanCost {
    double items = 0, simulations = 0;
    double answer_bytes = 0, data_bytes = 0;
    double core_seconds = 0;  ///< by rough costs of a step
};
PlanCost plan_cost(const job::Job& job);

/// Items, simulations, memory, output size and expected time of every stage on that many
/// cores, and what was found in the data.
std::string plan_text(const job::Job& job, int cores);

}  // namespace bemcal::plan
