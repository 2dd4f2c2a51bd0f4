/// What a model leaves, as functions of what the building may follow, at every hook where
/// it may enter: found together with the parameters, each as large as the readings speak
/// for it.
#pragma once

#include "effects/driver_functions.hpp"
#include "loop/baseline.hpp"
#include "loop/found_function.hpp"

#include <vector>

namespace bemcal::loop {

/// Functions that the standing model lacks. They join its place, and its parameters move
/// with them. Nothing where no function passes. The standing's unseen readings are scored
/// by the noise that it had.
std::vector<FoundFunction> find_functions(const LoopData& data, Place& place,
                                          Standing& standing);

/// Whether a model explains the readings that it is fitted to at least as well as its
/// halves foretell those that they have not seen. Else its parameters could not go where
/// its functions ask for them to be: what lies between could not be simulated.
bool explains_what_it_has_seen(const LoopData& data, const Standing& standing);

/// The place, of any period, with functions in place of those that it had.
/// \param drivers  of that period
Place with_functions(Place place, const std::vector<FoundFunction>& found,
                     const effects::FunctionDrivers& drivers);

}  // namespace bemcal::loop
