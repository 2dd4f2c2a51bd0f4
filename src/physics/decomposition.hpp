/// Irradiance from less than its parts: diffuse from global irradiance, global irradiance
/// of a clear and of a cloudy sky.
#pragma once

#include "physics/sun.hpp"

#include <vector>

namespace bemcal::physics {

/// Diffuse horizontal irradiance of every step from global horizontal irradiance [W/m2].
///
/// BRL model: Ridley, Boland, Lauret 2010, Renewable Energy 35(2), 478-483, with the
/// parameters of Lauret et al. 2013, Renewable Energy 50, 148-156 (nine sites). Hourly
/// steps.
/// \param suns    of the axis: SunOfStep::sunlit_part
/// \param global  a value for every step; no NaN
std::vector<double> diffuse_from_global(const Site& site, const TimeAxis& axis,
                                        const std::vector<StepSun>& suns,
                                        const std::vector<double>& global);

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
