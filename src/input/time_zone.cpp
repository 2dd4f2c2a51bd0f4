/// Tells a time zone that no place of that longitude keeps.
/// Source: the tz data base; standard time is furthest from the sun in Xinjiang (UTC+8 at
/// 73.5 degrees east: 3.1 h).
/// Leaves out zones that are wrong by less.
#include "input/time_zone.hpp"

#include <cmath>

namespace bemcal::input {

double zone_minus_sun(const physics::Site& site) {
    return std::remainder(site.utc_offset_h - site.longitude / 15, 24.0);
}

bool is_possible_zone(const physics::Site& site) {
    constexpr double furthest = 3.5;    // [h]
    constexpr double near_a_pole = 66;  // [deg]
    return site.utc_offset_h == 0 || std::abs(site.latitude) > near_a_pole ||
           std::abs(zone_minus_sun(site)) <= furthest;
}

}  // namespace bemcal::input
