/// Units that weather tables are published in, and whether a column can be in the unit
/// that is expected: irradiance against the sun outside the atmosphere, temperature
/// against what air does, humidity and wind against what there is anywhere.
#pragma once

#include "input/series.hpp"
#include "physics/site.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bemcal::checks {

/// What a column of weather holds.
enum class WeatherKind { temperature, irradiance, speed, humidity, cloud };

struct WeatherUnit {
    const char* name;
    WeatherKind kind;
    double factor, offset;  ///< value x factor + offset is degC, W/m2, m/s, % or 0 to 1
    bool per_step = false;  ///< an energy: of a step of one second
};

std::span<const WeatherUnit> weather_units();
/// The factor of a unit in rows of `step_s` seconds.
double factor_of(const WeatherUnit& unit, int step_s);

/// Which irradiance: each reaches another share of what arrives outside the atmosphere.
enum class SunColumn { global_horizontal, direct_normal, diffuse_horizontal };

/// Why readings are not in the unit that is expected, and in which they may be; nothing
/// where they are possible. Missing values are left out. Under two weeks irradiance is
/// never too low, and under two days nothing is said.
/// \param series  [W/m2], its steps as they begin
std::optional<std::string> doubt_of_irradiance(const input::RegularSeries& series,
                                               const physics::Site& site,
                                               SunColumn which);
/// \param series  [degC]
std::optional<std::string> doubt_of_temperature(const input::RegularSeries& series,
                                                const physics::Site& site);

/// \param series  [%]
std::optional<std::string> doubt_of_humidity(const input::RegularSeries& series);
/// \param series  [m/s], of two weeks or more
std::optional<std::string> doubt_of_wind(const input::RegularSeries& series);

}  // namespace bemcal::checks
