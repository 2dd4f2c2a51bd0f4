/// The day of training from which on the hours of what a model leaves differ most.
#pragma once

#include "effects/driver_functions.hpp"
#include "loop/baseline.hpp"

#include <optional>

namespace bemcal::loop {

/// In years from the first step of training; nothing where no meter is read by the hour,
/// or training is too short.
/// \param drivers  of the training period
std::optional<double> day_of_change(const LoopData& data, const Standing& standing,
                                    const effects::FunctionDrivers& drivers,
                                    const Place& place);

}  // namespace bemcal::loop
