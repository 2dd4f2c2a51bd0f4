/// A simulator that is another program: EnergyPlus, TRNSYS, a script.
///
/// For each point a folder is made, with the input files from their templates and links
/// to the files that all points share; the command runs in it; the outputs are read from
/// what it wrote. Whatever goes wrong becomes the point's reason.
#pragma once

#include "external/output_rule.hpp"
#include "external/text_template.hpp"
#include "study/hourly_simulator.hpp"
#include "study/simulator.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace bemcal::external {

/// Where output and messages of the command go, in the point's folder.
constexpr const char* standard_output = "stdout.txt";
constexpr const char* standard_error = "stderr.txt";

/// Which folders stay when their point is done.
enum class Keep { failed, all, none };

struct InputFile {
    std::string name;  ///< in the point's folder
    TextTemplate text;
};

struct CommandOptions {
    std::vector<physics::Parameter> parameters;
    std::vector<OutputRule> outputs;
    std::vector<OutputRule> hours;  ///< columns, called by their meters
    std::vector<InputFile> inputs;
    std::vector<std::filesystem::path> links;  ///< absolute paths
    std::string program;                       ///< absolute path
    std::vector<TextTemplate> arguments;       ///< the program's name first
    double time_limit_s = 600;
    double output_limit = 1e9;  ///< of each file that is written [bytes]
    Keep keep = Keep::failed;
    std::filesystem::path folder;  ///< the points' folders lie in it
};

/// The points' folders are called point-HASH, by the point's values.
std::shared_ptr<const study::Simulator> make_command_simulator(CommandOptions options);
/// The same of hours: what is missing in the building is handed over as effect_files.
std::shared_ptr<const study::HourlySimulator> make_hourly_simulator(
    CommandOptions options);

}  // namespace bemcal::external
