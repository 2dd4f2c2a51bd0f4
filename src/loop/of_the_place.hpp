/// Effects that come with a building's weather, so that all buildings beside have them,
/// too: what this building's readings say of each. A stock compares them.
#pragma once

#include "loop/power.hpp"
#include "study/summary.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace bemcal::loop {

/// Each row of the table that enters the outdoor air, beside the model that stands, all
/// parameters free. Those of which the readings say nothing are left out.
std::vector<study::PlaceEffect> effects_of_the_place(const LoopData& data,
                                                     const Place& place,
                                                     const Standing& standing,
                                                     const PowerTable& power);

/// A coefficient and its standard deviation by the parabola through -2 log likelihood at
/// -step, 0 and step; nothing where it has no lowest point within three steps.
std::optional<std::pair<double, double>> lowest_point(double below, double at_zero,
                                                      double above, double step);

}  // namespace bemcal::loop
