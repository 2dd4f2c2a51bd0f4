/// Irradiance from less than its parts: diffuse from global irradiance, global irradiance
/// of a clear and of a cloudy sky.
#pragma once

#include "physics/sun.hpp"

namespace bemcal::physics {

/// Diffuse horizontal irradiance of an hour from global horizontal irradiance [W/m2]:
/// Erbs, Klein and Duffie 1982, Solar Energy 28(4), 293-302.
///
/// Models with more inputs (Ridley, Boland and Lauret 2010; Engerer 2015; DISC) were
/// tried on a measured year and on typical years of six places: none was better in annual
/// sums.
/// \param sun  of the hour: SunOfStep::sunlit_part
double diffuse_from_global(double global, const StepSun& sun);

/// Global horizontal irradiance under a clear sky [W/m2]: Ineichen and Perez 2002, Solar
/// Energy 73(3), 151-157, for a Linke turbidity of 3.
/// \param zenith     [rad]
/// \param air_mass   corrected for pressure
/// \param elevation  [m]
double clear_sky_global(double zenith, double extraterrestrial, double air_mass,
                        double elevation);

/// The same under a cloud cover [0..1]: Kasten and Czeplak 1980, Solar Energy 24(2),
/// 177-189.
double cloudy_sky_global(double clear_sky, double cloud_cover);

}  // namespace bemcal::physics
