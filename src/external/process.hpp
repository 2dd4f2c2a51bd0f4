/// Another program, run to its end in a folder of its own, within a time limit.
///
/// A keeper stands between it and us, so that it ends together with all that it started:
/// at the time limit by SIGTERM and then SIGKILL, and what it leaves running when it or
/// we end by SIGKILL. It inherits no open file of ours, and no variable by which an MPI
/// program would take itself for one of our ranks.
#pragma once

#include "external/ended.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace bemcal::external {

/// Standard input is empty.
struct Command {
    std::string program;  ///< absolute path
    /// The first is what the program is called.
    std::vector<std::string> arguments;
    std::vector<std::string> environment;  ///< NAME=value
    std::filesystem::path folder;          ///< where it runs
    std::string output, error;             ///< files in the folder, for what it prints
    double time_limit_s = 60;
    double output_limit = 1e9;  ///< of each file that is written [bytes]
};

/// Thread-safe.
Ended run_command(const Command& command);

/// Kills all commands that run now, and starts no more: before the program ends while
/// threads still wait for some.
void end_commands();

/// Our own environment without what mpirun and its kin leave in it, and with one OpenMP
/// thread, as as many programs run at once as there are threads.
std::vector<std::string> environment_for_children();

/// The file that a name stands for: with a slash a path beside `folder`, without one
/// found on PATH; empty where nothing executable has it.
std::filesystem::path find_program(const std::string& name,
                                   const std::filesystem::path& folder);

}  // namespace bemcal::external
