/// [[scenario]] of another program: changes of its [[simulator.parameter]] by their
/// names, and of effects that a loop around it has found.
#pragma once

#include "retrofit/simulator_scenario.hpp"
#include "schema/section.hpp"

#include <vector>

namespace bemcal::job {

/// What scenarios may make of each of the program's parameters.
std::vector<retrofit::Limits> limits_of_scenarios(
    const schema::Section& root, const std::vector<physics::Parameter>& parameters);

/// \param has_effects  the study whose points are taken finds effects
std::vector<retrofit::SimulatorScenario> read_simulator_scenarios(
    const schema::Section& root, const std::vector<physics::Parameter>& parameters,
    const std::vector<retrofit::Limits>& limits, bool has_effects);

}  // namespace bemcal::job
