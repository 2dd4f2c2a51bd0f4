/// Clocks of all meters that are late or early by whole hours. What schedules that are as
/// late say nearly as well: but the weather's answer is late with a clock, not with a
/// schedule. Summer time beside it moves by how many hours, and is tried with it, for
/// that only. Clocks of single meters are `checks_clock` to find.
#pragma once

#include "loop/baseline.hpp"

#include <optional>

namespace bemcal::loop {

struct LateClock {
    int hours = 0;      ///< what all readings are stamped too late
    double gained = 0;  ///< fall of the objective, next to late schedules
};

/// Whether a clock explains more than an effect of a model does; nothing where the effect
/// is no shift of schedules by about whole hours, or where a meter is read by the day.
/// Both are asked in the standard's model: a structure that was chosen by late readings
/// has followed them.
std::optional<LateClock> late_clock_in_place_of(const LoopData& data,
                                                const Standing& standing,
                                                std::size_t effect);

/// The case with its readings stamped earlier, and a decision that says so.
study::Case with_clock_set(const study::Case& building, const LateClock& late);

/// A series of the building's hours by clocks that are late; missing at the end that it
/// does not reach.
std::vector<double> by_late_clock(const std::vector<double>& hours, int late);
/// The same, with the value of a day away there.
std::vector<double> by_late_clock_throughout(const std::vector<double>& hours, int late);

}  // namespace bemcal::loop
