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

/// Whether a model explains the readings that it is fitted to at least as well as its
/// halves foretell those that they have not seen. Else its parameters could not go where
/// its functions ask for them to be: what lies between could not be simulated.
bool explains_what_it_has_seen(const LoopData& data, const Standing& standing);

/// Gives a place, of any period, the columns that functions' effects follow.
/// \param drivers  of that period
void add_columns(const std::vector<FoundFunction>& found,
                 const effects::FunctionDrivers& drivers, Place& place);

}  // namespace bemcal::loop
