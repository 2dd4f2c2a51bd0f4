/// How long the intervals of a meter are, where their calendar does not matter.
#pragma once

#include "physics/meters.hpp"

namespace bemcal::physics {

/// Mean length [h]; of a simulation's step that of `step_s`.
inline double hours_of(const Intervals& intervals, int step_s) {
    const auto& bounds = intervals.bounds;
    if (bounds.size() > 1)
        return static_cast<double>((bounds.back() - bounds.front()).count()) / 3600 /
               static_cast<double>(bounds.size() - 1);
    switch (intervals.kind) {
        case Interval::step:
            return step_s / 3600.0;
        case Interval::hourly:
            return 1;
        case Interval::daily:
            return 24;
        case Interval::monthly:
            return 730;
        default:
            return 8760;
    }
}

}  // namespace bemcal::physics
