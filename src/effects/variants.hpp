/// An effect on every place or day that it may have in a building.
#pragma once

#include "effects/catalogue.hpp"

namespace bemcal::effects {

/// The effect on each of what `each` says; none for found days and data.
std::vector<Effect> variants(const Effect& effect, Each each,
                             const Surroundings& surroundings,
                             std::span<const physics::Quantity> meters);

/// "south facade", "roof"
std::string name_of_facade(const physics::Plane& plane);

}  // namespace bemcal::effects
