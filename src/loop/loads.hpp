/// What the plant of a calibrated model delivers: series that effects of its part load
/// follow.
#pragma once

#include "loop/baseline.hpp"

namespace bemcal::loop {

/// Fills the surroundings' series from the model, simulated over the place's period, with
/// its own largest powers as the scale. Once it is known in training, the scale is handed
/// on to the other periods. Leaves them empty where the model cannot be simulated.
void know_loads(Place& place, const Standing& calibrated);
void know_loads(Place& place, const Standing& calibrated,
                const effects::ModelSeries& in_training);

}  // namespace bemcal::loop
