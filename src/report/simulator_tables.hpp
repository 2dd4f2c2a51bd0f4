/// What a loop says of the program that it was around.
#pragma once

#include "loop/stored_simulator.hpp"
#include "report/lookup.hpp"

#include <string>

namespace bemcal::report {

/// Its parameters, its runs, how well the emulator foretold them; "" of other loops.
std::string simulator_tables(const loop::StoredSimulator& simulator);

/// How many runs there were and failed, and how well the emulator foretold them; "" where
/// the study is of no other program, or asks it for each point.
std::string simulator_run_lines(const loop::StoredSimulator& simulator);
std::string simulator_run_lines(const Group& study);

/// What was given to it, and what it could not take; "" where nothing was found.
std::string simulator_given_table(const loop::StoredSimulator& simulator);

}  // namespace bemcal::report
