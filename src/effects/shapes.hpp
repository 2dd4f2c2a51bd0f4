/// Short words for the shapes of the catalogue's rows and of the grammar.
#pragma once

#include "effects/effect.hpp"

#include <initializer_list>
#include <vector>

namespace bemcal::effects {

/// One shape for each threshold.
std::vector<Shape> at_each(Form form, std::initializer_list<double> thresholds);
/// Beginnings and ends of windows.
std::vector<Shape> windows(std::initializer_list<Hours> ends);
/// Seasons of three, four and six months, in days of the year.
std::vector<Shape> seasons();
/// Steps of the time elapsed, at every month of two years.
std::vector<Shape> dates();

/// An effect that begins on one of these dates.
Effect from_a_date(const char* name, int number, Hook hook, double least, double most,
                   double typical);

}  // namespace bemcal::effects
