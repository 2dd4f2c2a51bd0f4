/// The catalogue's rows in three groups, and short words for their shapes.
#pragma once

#include "effects/entry.hpp"

#include <initializer_list>
#include <vector>

namespace bemcal::effects {

std::vector<Entry> envelope_rows();  ///< weather, air, walls and windows: 1 to 18
std::vector<Entry> use_rows();       ///< people, schedules and set-points: 19 to 33
std::vector<Entry> plant_rows();     ///< plant, meters and clocks: 34 to 45

/// One shape for each threshold.
std::vector<Shape> at_each(Form form, std::initializer_list<double> thresholds);
/// Beginnings and ends of windows.
std::vector<Shape> windows(std::initializer_list<Hours> ends);
/// Seasons of three, four and six months, in days of the year.
std::vector<Shape> seasons();
/// Steps of the time elapsed, at every month of two years.
std::vector<Shape> dates();

}  // namespace bemcal::effects
