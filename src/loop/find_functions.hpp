/// What a model leaves, as functions of what the building may follow, at every hook where
/// it may enter: found together with the parameters, each as large as the readings speak
/// for it.
#pragma once

#include "effects/driver_functions.hpp"
#include "loop/baseline.hpp"
#include "loop/found_function.hpp"

#include <vector>

namespace bemcal::loop {

/// Functions that the standing model lacks. They join it as effects that follow columns
/// of the place, one for each hook, after those that it has; its parameters move with
/// them. Nothing where no function passes.
std::vector<FoundFunction> find_functions(const LoopData& data, Place& place,
                                          Standing& standing);

/// Gives a place, of any period, the columns that functions' effects follow.
/// \param drivers  of that period
void add_columns(const std::vector<FoundFunction>& found,
                 const effects::FunctionDrivers& drivers, Place& place);

}  // namespace bemcal::loop
