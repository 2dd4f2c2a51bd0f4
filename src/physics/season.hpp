/// Heating and cooling seasons by weather: heating stops where the running mean of the
/// outdoor temperature is above a limit, cooling where it is below one.
///
/// Not all rooms change over on one day. The share of rooms that are heated falls in a
/// line from 1 to 0 over season_ramp about the limit, and a zone's power is that share of
/// the power that would hold the set-point in all of it.
#pragma once

#include "physics/building.hpp"
#include "physics/weather.hpp"

#include <vector>

namespace bemcal::physics {

constexpr double season_ramp = 2;  ///< from all rooms to none [K]

/// \param theta_rm  running mean of the outdoor temperature [degC]
/// \return share of rooms that are heated [-]
double heated_share(const Structure& structure, double theta_rm);
double cooled_share(const Structure& structure, double theta_rm);

/// Running mean of the outdoor temperature on the steps of `source`, the same all day
/// [degC]: 0.2 of the mean of the day before and 0.8 of what it was then. The first day
/// of the weather has its own mean, and a day without values changes nothing. In classes
/// of half a kelvin, by their middle, so that the fast simulation has few regimes.
std::vector<double> running_means(const Weather& weather, const TimeAxis& source);

}  // namespace bemcal::physics
