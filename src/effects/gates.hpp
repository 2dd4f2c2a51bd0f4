/// When an effect has a say: the gates that let it through.
#pragma once

#include "effects/surroundings.hpp"

namespace bemcal::effects {

/// Share of the step in which the gate, the weekday and the hours let it through
/// [n_steps]; empty where the surroundings lack what the gate asks for.
std::vector<double> gate_of(const Effect& effect, const Surroundings& surroundings);

}  // namespace bemcal::effects
