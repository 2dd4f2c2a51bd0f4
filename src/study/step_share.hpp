/// What a step of unknown size and moment brings on one day.
#pragma once

#include <algorithm>
#include <cstddef>

namespace bemcal::study {

/// The size times the share of day [at, at + 1) that lies behind the moment.
struct StepShare {
    std::size_t size = 0, moment = 0;  ///< indices of the two unknowns; the moment in d
    double at = 0;                     ///< [d]

    double share(double moment_value) const {
        return std::clamp(at + 1 - moment_value, 0.0, 1.0);
    }
    /// By the moment.
    double slope(double moment_value) const {
        return moment_value > at && moment_value < at + 1 ? -1 : 0;
    }
};

}  // namespace bemcal::study
