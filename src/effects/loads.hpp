/// What the plant of a building delivers in a period: series that effects of its part
/// load follow.
#pragma once

#include "effects/surroundings.hpp"

namespace bemcal::effects {

/// Heating and cooling of a building, with the largest as the scale. Throws
/// CannotSimulate.
ModelSeries loads_of(const physics::Building& building, const physics::Drive& drive);

/// None, of a drive's steps: for what is placed before a simulation tells.
ModelSeries no_loads(const physics::Drive& drive);

}  // namespace bemcal::effects
