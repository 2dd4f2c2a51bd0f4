/// Matern's correlation of order 5/2 at the squared distance in units of the lengths, and
/// its slope: Rasmussen and Williams 2006, eq. 4.17.
#pragma once

#include <cmath>

namespace bemcal::emulator {

struct Matern {
    double correlation;
    double slope;  ///< d correlation / d (squared distance)
};

inline Matern matern_at(double squared_distance) {
    const double r = std::sqrt(5 * squared_distance), decay = std::exp(-r);
    return {(1 + r + r * r / 3) * decay, -5. / 6 * (1 + r) * decay};
}

}  // namespace bemcal::emulator
