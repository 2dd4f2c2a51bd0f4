/// What an effect reads at every step, before its shape: driver and gate.
#pragma once

#include "effects/surroundings.hpp"

namespace bemcal::effects {

/// The driver [n_steps]; empty where the surroundings lack it. Of another_day and
/// shifted_hours: 1, since their profiles are those of each input (schedules.hpp).
std::vector<double> driver_of(const Effect& effect, const Surroundings& surroundings);

/// Share of the step in which the gate, the weekday and the hours let it through
/// [n_steps]; empty where the surroundings lack what the gate asks for.
std::vector<double> gate_of(const Effect& effect, const Surroundings& surroundings);

/// Share of the step's time that lies in these hours of the day.
double share_of(const Hours& hours, const Surroundings& surroundings, int step);

/// Density of people over its largest [n_steps]: of the loads named people or occupants,
/// else of all that follow a profile; empty where there are none.
std::vector<double> occupation_of(const Surroundings& surroundings);

/// Whether two planes face the same way.
bool same_facade(const physics::Building& building, int plane, int other);

}  // namespace bemcal::effects
