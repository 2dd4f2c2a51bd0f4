/// What a job will cost, in words: for `check`.
#pragma once

#include "job/job.hpp"

#include <string>

namespace bemcal::job {

/// Items, simulations, memory, output size and expected time of every stage on that many
/// cores, and what was found in the data.
std::string plan_text(const Job& job, int cores);

}  // namespace bemcal::job
