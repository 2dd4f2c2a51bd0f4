/// A process between us and a command, which outlives neither: it ends the command and
/// all that descends from it, in sessions of their own too, at the time limit, when the
/// command ends, and when we do, killed or not.
///
/// It is this program once more, under another name: a process that only watches, without
/// our threads, memory and files. Orphans of the command become its children (a
/// subreaper), so that none gets away by leaving its group, session or parent.
#pragma once

#include "external/ended.hpp"

#include <string>
#include <vector>

namespace bemcal::external {

struct Kept {
    double time_limit_s = 60;
    double output_limit = 1e9;  ///< of each file that is written [bytes]
    std::string program;        ///< absolute path
    std::vector<std::string> arguments;
};

/// Where the keeper writes an `Ended`, once all is over.
constexpr int report_descriptor = 3;

/// The file to start, and its arguments.
constexpr const char* keeper_program = "/proc/self/exe";
std::vector<std::string> keeper_arguments(const Kept& kept);

}  // namespace bemcal::external
