/// [simulator]: another program in place of a building.
#pragma once

#include "external/command_simulator.hpp"
#include "input/input_files.hpp"
#include "schema/section.hpp"

#include <string>
#include <utility>

namespace bemcal::description {

/// \param job  its name: of the folder of the points' folders, where the section has none
external::CommandOptions read_simulator(const schema::Section& section,
                                        input::InputFiles& files, const std::string& job);

/// The least and the most that a scenario may make of a [[simulator.parameter]].
std::pair<double, double> read_scenario_limits(const schema::Section& section,
                                               const physics::Parameter& parameter);

}  // namespace bemcal::description
