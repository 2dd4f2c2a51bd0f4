/// The bases that the training period makes of what functions may follow.
#pragma once

#include "effects/driver_functions.hpp"
#include "functions/basis.hpp"

#include <optional>
#include <vector>

namespace bemcal::loop {

/// Without the warm-up.
std::vector<std::vector<double>> of_period(std::vector<std::vector<double>> all,
                                           const physics::Drive& drive);

/// One for each driver. \param training  the drivers of the training period
/// \param day  from which on hours may be others, in years; nothing: there is no such
std::vector<functions::Basis> bases_of(const effects::FunctionDrivers& training,
                                       const physics::Drive& drive,
                                       std::optional<double> day);

}  // namespace bemcal::loop
