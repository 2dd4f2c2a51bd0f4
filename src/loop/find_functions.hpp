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

/// Of a model and what its halves foretold of blocks that they had not seen (left_out):
/// the deviance of that, but no less than its own of all readings. Where its parameters
/// could not go to where its functions ask for them to be, since what lies between cannot
/// be simulated, the halves promise more than it keeps.
double score_of_halves(const LoopData& data, const Standing& whole);

/// Whether no meter's unseen readings are foretold worse, or little beside what the best
/// meter gains. By left_out, residuals and the noise of `without`.
bool spares_meters(const LoopData& data, const Standing& without, const Standing& with);

/// The place, of any period, with functions in place of those that it had.
/// \param drivers  of that period
Place with_functions(Place place, const std::vector<FoundFunction>& found,
                     const effects::FunctionDrivers& drivers);
/// The same with what its surroundings know.
void add_functions(Place& place, const std::vector<FoundFunction>& found);

}  // namespace bemcal::loop
