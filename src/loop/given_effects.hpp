/// What a loop found, as another program can be given it: for each effect the hours of
/// all periods at the hooks that it changes.
#pragma once

#include "loop/results.hpp"
#include "study/hourly_simulator.hpp"

#include <vector>

namespace bemcal::loop {

/// Effects found, then all functions as one, at the last fit's values; an effect without
/// any change at a hook has an empty `at`. Throws CannotSimulate where a period lacks
/// what an effect follows.
std::vector<study::GivenEffect> given_effects(const LoopData& data,
                                              const LoopResult& result);

}  // namespace bemcal::loop
