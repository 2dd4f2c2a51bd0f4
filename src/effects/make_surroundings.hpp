/// Surroundings from a building, its drive and the weather.
#pragma once

#include "effects/surroundings.hpp"

namespace bemcal::effects {

/// The weather's drivers laid on the drive's steps, warm-up included; an hour's value
/// holds for its steps. Before the weather begins its first days repeat; gaps hold the
/// last value. A series that the weather lacks, or of which more than a tenth is missing,
/// stays empty, and no effect follows it. `ground`: theta_e before the weather begins is
/// taken to be as in its first year.
/// \param from  the beginning of training: the same for every period
Surroundings make_surroundings(const physics::Building& building,
                               const physics::Drive& drive,
                               const physics::Weather& weather, physics::Seconds from);

}  // namespace bemcal::effects
