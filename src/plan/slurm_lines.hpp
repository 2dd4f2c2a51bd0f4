/// What to ask Slurm for, from the plan: the #SBATCH lines of `check --slurm`.
///
/// Leaves out partitions and accounts, which are the cluster's.
#pragma once

#include "plan/cost.hpp"

#include <string>

namespace bemcal::plan {

struct SlurmRequest {
    int n_nodes = 0;         ///< 0 = one
    int cores_per_node = 0;  ///< 0 = as many as make it half an hour, at most 16
};

/// Ranks of up to eight cores, no more cores than items; one and a half times the plan's
/// memory, of each node; twice its time and ten minutes, at most a day (an unfinished job
/// goes on from the queue).
std::string slurm_lines(const PlanCost& cost, const SlurmRequest& request);

}  // namespace bemcal::plan
