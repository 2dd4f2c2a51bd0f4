/// What else of a loop's model a job can have beside the effects found: structure, hours
/// learned, functions.
#pragma once

#include "loop/baseline.hpp"
#include "loop/found_function.hpp"
#include "loop/learn_hours.hpp"
#include "loop/stored_loop.hpp"

#include <vector>

namespace bemcal::loop {

/// \param place       of the structure chosen
/// \param deviations  of last's unknowns
std::vector<StoredLoop::JobPart> job_parts_of(
    const LoopData& data, const Place& place, const Standing& last,
    const std::vector<double>& deviations, const std::vector<LearnedHours>& hours,
    const std::vector<FoundFunction>& functions);

}  // namespace bemcal::loop
