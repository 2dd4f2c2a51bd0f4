/// Where the sun is.
#pragma once

#include "physics/weather.hpp"

namespace bemcal::physics {

struct SunPosition {
    double zenith;               ///< [rad], without refraction
    double azimuth;              ///< [rad], clockwise from north
    double extraterrestrial;     ///< normal irradiance outside the atmosphere [W/m2]
};

/// Position at an instant, within 0.05 deg of NREL's SPA for years 1950 to 2050.
SunPosition sun_position(const Site& site, Seconds local_standard);

/// Cosine of the angle between the sun and a plane's normal; negative behind the plane.
/// \param tilt     [rad], 0 = facing up, pi/2 = vertical
/// \param azimuth  of the plane's outward normal [rad], clockwise from north
double cos_incidence(const SunPosition& sun, double tilt, double azimuth);

}  // namespace bemcal::physics
