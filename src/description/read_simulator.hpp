/// [simulator]: another program in place of a building.
#pragma once

#include "external/command_simulator.hpp"
#include "input/input_files.hpp"
#include "schema/section.hpp"

#include <string>

namespace bemcal::description {

/// \param job  its name: of the folder of the points' folders, where the section has none
external::CommandOptions read_simulator(const schema::Section& section,
                                        input::InputFiles& files, const std::string& job);

}  // namespace bemcal::description
