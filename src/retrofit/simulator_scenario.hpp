/// What a retrofit changes of another program's model: its parameters, and the effects
/// that a loop around it has found.
#pragma once

#include "retrofit/scenario.hpp"
#include "study/given_effects.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::retrofit {

/// Of a number of the program, or of an effect, which is struck (0) or scaled.
struct SimulatorChange {
    std::size_t parameter = 0;  ///< of the program
    std::string effect;         ///< in its place, by its name; "" = none
    ChangeBy by = ChangeBy::value;
    double amount = 0;
};

struct SimulatorScenario {
    std::string name;
    std::vector<SimulatorChange> changes;  ///< one after the other
};

/// What a scenario may make of a parameter.
struct Limits {
    double least, most;
};

/// "0.1 to 2 W/(m2 K)"; a unit of "-" is left out.
std::string words_of(const Limits& limits, const physics::Parameter& parameter);

/// What the program is run with.
struct SimulatorInput {
    std::vector<double> values;  ///< [parameters]
    std::vector<study::GivenEffect> effects;
};

/// The input after the scenario.
SimulatorInput after(SimulatorInput input, const SimulatorScenario& scenario);

/// A parameter that the scenario leads outside its limits, in words; "" = none.
/// \param limits  [parameters]
std::string beyond_limits(const SimulatorInput& before, const SimulatorScenario& scenario,
                          const std::vector<physics::Parameter>& parameters,
                          std::span<const Limits> limits);

/// An effect that the scenario changes and that was not found, in words; "" = none.
std::string missing_effect(const SimulatorScenario& scenario,
                           const std::vector<study::GivenEffect>& found);

}  // namespace bemcal::retrofit
