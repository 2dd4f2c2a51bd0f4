/// What functions follow: series of a period, and the bases that training makes of them.
#pragma once

#include "functions/basis.hpp"
#include "loop/model.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::loop {

/// By the name of a basis' driver: one series, or two of an interaction, of all steps of
/// a drive. [drivers][steps]
using FunctionDrivers = std::map<std::string, std::vector<std::vector<double>>>;

/// Those that the place's weather and model know.
FunctionDrivers function_drivers(const LoopData& data, const Place& place);

/// Without the warm-up.
std::vector<std::vector<double>> of_period(std::vector<std::vector<double>> all,
                                           const physics::Drive& drive);

/// Of what a basis' driver is measured in, of an interaction that of what is not the
/// hour;
/// "" = none, of the constant.
std::string unit_of_driver(const std::string& name);

/// One for each driver. \param training  the drivers of the training period
std::vector<functions::Basis> bases_of(const FunctionDrivers& training,
                                       const physics::Drive& drive);

}  // namespace bemcal::loop
