/// Inputs that enter a zone's balance linearly (temperatures, densities of loads), split
/// into what drivers bring step by step and the rest, which a table holds.
///
/// A driver is a profile: what follows it alone is its value times a constant. That is
/// the input's own profile, unless a change multiplies it, and every change of kind
/// shift.
#pragma once

#include "physics/drive.hpp"

#include <algorithm>

namespace bemcal::kernel {

inline bool contains(const std::vector<int>& profiles, int profile) {
    return std::find(profiles.begin(), profiles.end(), profile) != profiles.end();
}

/// Whether no change multiplies anything.
bool is_linear(const physics::Input& input);

/// Whether anything of it follows the profile, which is a driver.
bool follows(const physics::Input& input, int profile);

/// What the input gains per value of a driver.
double along(const physics::Input& input, int profile);
void pull_along(const physics::Input& input, int profile, double of_along,
                physics::Input& of_input);

/// Of an input with changes.
double tabled_changed(const physics::Input& input, const std::vector<int>& drivers,
                      const physics::Drive& drive, int step);
/// The input at a step, without what the drivers bring.
inline double tabled(const physics::Input& input, const std::vector<int>& drivers,
                     const physics::Drive& drive, int step) {
    if (input.is_changed()) return tabled_changed(input, drivers, drive, step);
    if (input.profile < 0) return input.value;
    return contains(drivers, input.profile) ? input.low : drive.at(input, step);
}
void pull_tabled(const physics::Input& input, const std::vector<int>& drivers,
                 const physics::Drive& drive, int step, double of_value,
                 physics::Input& of_input);

}  // namespace bemcal::kernel
