/// What an effect brings at every step per coefficient: shape(driver) x gate.
#pragma once

#include "effects/surroundings.hpp"

namespace bemcal::effects {

/// Whether all that the effect follows is there.
bool is_known(const Effect& effect, const Surroundings& surroundings);

/// shape(driver) x gate at every step [n_steps]. Throws CannotSimulate where not
/// is_known.
std::vector<double> profile_of(const Effect& effect, const Surroundings& surroundings);

}  // namespace bemcal::effects
