/// Whose points retrofits are applied to, and what counts as comfort: of our own model
/// and of another program alike.
#pragma once

#include "physics/parameters.hpp"
#include "study/summary.hpp"

#include <string>
#include <vector>

namespace bemcal::retrofit {

/// An hour counts as occupied from this value of the schedule on.
inline constexpr double occupied_from = 0.5;

struct Setting {
    std::string of;             ///< name of the stage whose points are taken
    int n_points = 200;         ///< at most, evenly spread
    int occupied_profile = -1;  ///< of the case; -1 = all hours count
    double too_cold = 19;       ///< [degC] below it
    double too_warm = 26;       ///< [degC] above it
};

/// Hours of a room outside the limits.
struct ComfortHours {
    double too_cold = 0, too_warm = 0;
};
/// Counts an hour, or a part of one, at a temperature.
void count(const Setting& setting, double temperature, double hours, ComfortHours& to);

/// Points of these parameters that a study found: all draws of a posterior, or the best
/// points of a screening or grid, best first. Parameters that were not calibrated are
/// nominal. [0 x parameters] where there is none. \param found  nullptr = none
Matrix points_in(const study::Summary* found,
                 const std::vector<physics::Parameter>& parameters);

/// At most so many of them, evenly spread.
Matrix some_of(const Matrix& points, int n_points);

}  // namespace bemcal::retrofit
