/// How long the intervals of a meter are, where their calendar does not matter.
#pragma once

#include "physics/meters.hpp"

namespace bemcal::physics {

/// Mean length [h]; of a simulation's step that of `step_s`.
inline double hours_of(Interval interval, int step_s) {
    switch (interval) {
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
