/// Hours that another program simulated, as the meters of a building would have read
/// them in training; and a building with other readings there.
#pragma once

#include "loop/model.hpp"

#include <vector>

namespace bemcal::loop {

/// What the channels would have read in training. [targets.size()]
/// \param hours  [channels][hours of all periods]
std::vector<double> readings_from(const LoopData& data,
                                  const std::vector<std::vector<double>>& hours);

/// Its place among the building's periods.
std::size_t place_of_training(const LoopData& data);

/// The data's building with these readings in training, where it has readings. \param
/// readings  [targets.size()]
study::Case with_readings(const LoopData& data, std::span<const double> readings);

}  // namespace bemcal::loop
