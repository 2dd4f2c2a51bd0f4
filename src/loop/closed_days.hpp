/// Days on which a building was closed and nobody said so: working days whose hours look
/// like a Sunday's.
#pragma once

#include "loop/baseline.hpp"

#include <optional>

namespace bemcal::loop {

/// Operation as on Sunday on the days that show it; none: no such day. Each day is held
/// against what closing it would do to the meters, simulated for every third day at a
/// time, since the response of a day has died before the third.
std::optional<effects::Effect> closed_days(const LoopData& data, const Place& place,
                                           const Standing& standing);

}  // namespace bemcal::loop
