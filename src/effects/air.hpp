/// Moist air and the sky above it, hour by hour: what weather files imply and do not say.
#pragma once

#include "physics/weather.hpp"

#include <vector>

namespace bemcal::effects {

/// Apparent temperature of the sky [degC] from its infrared irradiance [W/m2].
double sky_temperature(double infrared);

/// Infrared irradiance from the sky [W/m2] by air temperature [degC], relative humidity
/// [%] and cloud cover [0..1]: Clark and Allen 1978 with Walton's clouds, as in the
/// EnergyPlus Engineering Reference ("Sky Radiation Modeling").
double sky_infrared(double theta, double relative_humidity, double cloud_cover);

/// For every step of the weather; empty where it lacks what they need, NaN where a value
/// of that is missing.
std::vector<double> moisture_series(const physics::Weather& weather);        ///< [g/kg]
std::vector<double> sky_difference_series(const physics::Weather& weather);  ///< [K]

/// theta_e as the ground feels it: an exponentially weighted mean with a time constant of
/// 60 days; before the first step the weather's first year repeats [degC].
std::vector<double> ground_series(const physics::Weather& weather);

/// theta_e, mean of the calendar year in the weather; of a year of which the weather has
/// less than a half, mean of all [degC].
std::vector<double> yearly_mean_series(const physics::Weather& weather);

}  // namespace bemcal::effects
