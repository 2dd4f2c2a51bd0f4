/// Whether a clock belongs to a place.
#pragma once

#include "physics/weather.hpp"

namespace bemcal::input {

/// How far the time zone is from the sun's clock at the longitude [h], -12 to 12.
double zone_minus_sun(const physics::Site& site);

/// False where no land keeps such a zone; UTC is possible anywhere, and anything near a
/// pole.
bool is_possible_zone(const physics::Site& site);

}  // namespace bemcal::input
