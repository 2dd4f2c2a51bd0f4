/// A simulator that is another program: EnergyPlus, TRNSYS, a script.
///
/// For each point a folder is made, with the input files from their templates and links
/// to the files that all points share; the command runs in it; the outputs are read from
/// what it wrote. Whatever goes wrong becomes the point's reason.
#pragma once

#include "external/command_options.hpp"
#include "study/hourly_simulator.hpp"
#include "study/simulator.hpp"

#include <memory>

namespace bemcal::external {

/// The points' folders are called point-HASH, by the point's values.
std::shared_ptr<const study::Simulator> make_command_simulator(CommandOptions options);
/// The same of hours: what is missing in the building is handed over as effect_files.
std::shared_ptr<const study::HourlySimulator> make_hourly_simulator(
    CommandOptions options);

}  // namespace bemcal::external
