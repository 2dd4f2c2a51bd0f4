/// Random buildings whose zones are heated and cooled by the season.
#pragma once

#include "kernel/random_hooks.hpp"

#include <algorithm>

namespace bemcal::physics::test {

/// Running means by the day, in classes of half a kelvin.
inline void add_running_means(Drive& drive) {
    const std::size_t per_day = static_cast<std::size_t>(day_s / drive.axis.step_s);
    for (std::size_t k = 0; k < drive.theta_e.size(); ++k) {
        const double noon = drive.theta_e[k - k % per_day + per_day / 2];
        drive.theta_rm.push_back(std::floor(2 * noon) / 2 + 0.25);
    }
}

/// Limits amid what the weather has, one or both; a parameter moves each.
inline RandomCase random_seasonal_case(unsigned seed) {
    RandomCase made = random_hooked_case(seed);
    Dice dice(seed + 1000);
    add_running_means(made.drive);
    const auto [least, most] = std::ranges::minmax(made.drive.theta_rm);
    const double middle = 0.5 * (least + most);
    const int which = dice.below(3);
    for (Zone& zone : made.building.zones) {
        if (which != 0) zone.structure.heating_limit = middle + dice.between(-2, 2);
        if (which != 1) zone.structure.cooling_limit = middle + dice.between(-3, 0);
    }
    if (which != 0)
        made.parameters.push_back(
            parameter(made.building, "zone.*.heating_limit", -2, 2, Effect::offset));
    if (which != 1)
        made.parameters.push_back(
            parameter(made.building, "zone.*.cooling_limit", -2, 2, Effect::offset));
    return made;
}

}  // namespace bemcal::physics::test
