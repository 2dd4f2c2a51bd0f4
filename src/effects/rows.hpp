/// The catalogue's rows in three groups; a new effect is a row in one of them.
#pragma once

#include "effects/catalogue.hpp"

namespace bemcal::effects {

std::vector<Entry> envelope_rows();  ///< weather, air, walls and windows
std::vector<Entry> use_rows();       ///< people, schedules and set-points
std::vector<Entry> plant_rows();     ///< plant, meters and clocks

}  // namespace bemcal::effects
