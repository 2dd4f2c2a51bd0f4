/// What the plant of a standing model delivers: series that effects of its part load
/// follow.
#pragma once

#include "loop/baseline.hpp"
#include "loop/found_function.hpp"

namespace bemcal::loop {

/// Fills the surroundings' series from the standing model, with these functions,
/// simulated over the place's period; the place has the functions then. The scale is the
/// largest in the first simulation of the place, and stays. Leaves the series empty where
/// the model cannot be simulated.
void know_loads(Place& place, const Standing& standing,
                const std::vector<FoundFunction>& functions);

/// The same of a model that stays: what the description declares follows its loads, too.
void know_its_loads(const LoopData& data, Place& place, const Standing& standing,
                    const std::vector<FoundFunction>& functions);

/// Whether something of the model follows loads, found or declared.
bool follow_loads(const LoopData& data, const LoopModel& model,
                  const std::vector<FoundFunction>& functions);

/// Where a last model follows loads: those of itself at the parameters that it ends with,
/// as a job that declares it would find them. Parameters move with them, unless functions
/// had been found beside them.
/// \param place  of the model, with these functions
void settle_loads(const LoopData& data, const std::vector<FoundFunction>& functions,
                  Place& place, Standing& last);

}  // namespace bemcal::loop
