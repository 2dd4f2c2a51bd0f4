/// The search for the effects of a building: which join its model, in what order, and
/// which leave again.
#pragma once

#include "loop/late_clock.hpp"
#include "loop/results.hpp"
#include "loop/under_way.hpp"

#include <optional>

namespace bemcal::loop {

/// Adds to result.last what passes, from the model that stands there, and says of it what
/// is to be said.
/// \return what ended the search: all of it is to be done again by the right hour
std::optional<LateClock> search_effects(const LoopData& data, LoopResult& result,
                                        UnderWay& under_way, bool may_set_clock);

/// One more effect, where functions have taken the model's misfit off the readings. Says
/// whether one joined whose evidence and name leave no doubt.
bool add_effect_beside_functions(const LoopData& data, LoopResult& result,
                                 UnderWay& under_way);

/// Whether the evidence of one that joined so is far enough above what noise shows.
bool tells_beside_functions(const Found& found);

}  // namespace bemcal::loop
