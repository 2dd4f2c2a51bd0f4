/// A place on Earth, its clock and its ground.
#pragma once

#include <numbers>

namespace bemcal::physics {

inline constexpr double deg = std::numbers::pi / 180;  ///< [rad]

struct Site {
    double latitude = 0;      ///< [deg], north positive
    double longitude = 0;     ///< [deg], east positive
    double utc_offset_h = 0;  ///< local standard time minus UTC [h]
    double elevation = 0;     ///< [m]
    double albedo = 0.2;      ///< ground reflectance [-]
};

}  // namespace bemcal::physics
