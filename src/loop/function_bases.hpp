/// The bases that the training period makes of what functions may follow.
#pragma once

#include "effects/driver_functions.hpp"
#include "functions/basis.hpp"

#include <vector>

namespace bemcal::loop {

/// Without the warm-up.
std::vector<std::vector<double>> of_period(std::vector<std::vector<double>> all,
                                           const physics::Drive& drive);

/// One for each driver. \param training  the drivers of the training period
std::vector<functions::Basis> bases_of(const effects::FunctionDrivers& training,
                                       const physics::Drive& drive);

}  // namespace bemcal::loop
