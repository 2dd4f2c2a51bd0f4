/// Weather as the model needs it: means over each step, in local standard time.
#pragma once

#include "physics/calendar.hpp"
#include "physics/site.hpp"

#include <vector>

namespace bemcal::physics {

/// All series have axis.n_steps values; an optional one may be empty. NaN = missing.
struct Weather {
    Site site;
    TimeAxis axis;                ///< hourly
    std::vector<double> theta_e;  ///< outdoor air temperature, mean of the step [degC]
    std::vector<double> direct_normal;       ///< [W/m2]
    std::vector<double> diffuse_horizontal;  ///< [W/m2]
    std::vector<double> global_horizontal;   ///< [W/m2]
    std::vector<double> wind_speed;          ///< [m/s], optional
    std::vector<double> relative_humidity;   ///< [%], optional
    std::vector<double> cloud_cover;         ///< [0..1], optional
    std::vector<double> infrared;  ///< horizontal infrared from the sky [W/m2], optional
};

/// Steps with the sun up whose irradiance complete_irradiance cannot fill.
std::vector<int> unknown_irradiance(const Weather& weather);

/// Makes parts missing on days on which they are 0 and cannot be: some files write 0 for
/// what they do not have. Direct and diffuse where there is global irradiance, direct
/// where the diffuse part is well below the global; global where there are both parts.
/// \return the begins of these days
std::vector<Seconds> drop_absent_parts(Weather& weather);

/// Fills global, direct and diffuse irradiance where they are missing: two of them give
/// the third, global alone is split by a decomposition model, and where there is nothing,
/// clear-sky irradiance is scaled by cloud cover. With the sun down a missing value is 0.
/// Throws std::invalid_argument where none of this is possible, naming the first step.
void complete_irradiance(Weather& weather);

/// Mean of each hour from values read at the hours' ends: (T[k-1] + T[k]) / 2; the first
/// value stands alone. ISO 13790 leaves the choice open; for free-floating rooms it is
/// the better one.
std::vector<double> hour_means(const std::vector<double>& at_hour_end);

}  // namespace bemcal::physics
