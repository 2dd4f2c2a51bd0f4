/// What a job of buildings will cost, stage by stage and all together.
#pragma once

#include "job/job.hpp"

#include <string>
#include <vector>

namespace bemcal::plan {

struct StageCost {
    std::string name;
    double items = 0, simulations = 0;
    double answer_bytes = 0;   ///< on rank 0, and about those of the result
    double core_seconds = 0;   ///< by rough costs of a step
    double working_bytes = 0;  ///< on every rank that works on an item
};
/// In the order of the stages. Throws UserError (config) where a study does not fit.
std::vector<StageCost> stage_costs(const job::Job& job);

/// Of all stages together.
struct PlanCost {
    double items = 0, simulations = 0;
    double answer_bytes = 0, data_bytes = 0;
    double core_seconds = 0;   ///< by rough costs of a step
    double working_bytes = 0;  ///< of the stage that takes most
};
PlanCost total_of(const std::vector<StageCost>& stages, const job::Job& job);

/// Of a job that is not a stock. Throws UserError (config) where it has no study.
PlanCost cost_of_buildings(const job::Job& job);

}  // namespace bemcal::plan
