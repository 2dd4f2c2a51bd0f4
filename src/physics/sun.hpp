/// Where the sun is, and how much air lies before it.
#pragma once

#include "physics/calendar.hpp"
#include "physics/site.hpp"

#include <vector>

namespace bemcal::physics {

struct SunPosition {
    double zenith;            ///< [rad], without refraction
    double azimuth;           ///< [rad], clockwise from north, 0 to 2 pi
    double extraterrestrial;  ///< normal irradiance outside the atmosphere [W/m2]
};

/// Position at an instant, within 0.05 deg of NREL's SPA for years 1950 to 2050.
SunPosition sun_position(const Site& site, Seconds local_standard);

/// Where the sun stands for values that are means of a step: at the step's middle (as in
/// most programs; a beam is lost where the sun is not up then), or at the middle of its
/// sunlit part.
enum class SunOfStep { middle, sunlit_part };

struct StepSun {
    SunPosition position;
    double sunlit = 0;  ///< share of the step with the sun up [0..1]; `middle`: 0 or 1
};

/// The sun of every step. Where no part is sunlit: at the step's middle.
std::vector<StepSun> step_suns(const Site& site, const TimeAxis& axis,
                               SunOfStep which = SunOfStep::middle);

/// Relative air mass, Kasten and Young 1989; its value at the horizon below it.
/// \param zenith [rad]
double air_mass(double zenith);

/// Cosine of the angle between the sun and a plane's normal; negative behind the plane.
/// \param tilt     [rad], 0 = facing up, pi/2 = vertical
/// \param azimuth  of the plane's outward normal [rad], clockwise from north
double cos_incidence(const SunPosition& sun, double tilt, double azimuth);

}  // namespace bemcal::physics
