/// What is known of a command before it runs: inputs, arguments, outputs, limits.
#pragma once

#include "external/effect_places.hpp"
#include "external/output_rule.hpp"
#include "external/text_template.hpp"
#include "physics/parameters.hpp"

#include <filesystem>
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
    /// In templates, behind the parameters; none: effects are handed over as
    /// effect_files.
    std::vector<EffectPlace> places{};
    std::vector<InputFile> inputs;
    std::vector<std::filesystem::path> links;  ///< absolute paths
    std::string program;                       ///< absolute path
    std::vector<TextTemplate> arguments;       ///< the program's name first
    /// Written for each run with the periods that are asked for; linked as it is where
    /// none are. "" = the program is always run for all.
    std::filesystem::path periods_file;
    double time_limit_s = 600;
    double output_limit = 1e9;  ///< of each file that is written [bytes]
    Keep keep = Keep::failed;
    std::filesystem::path folder;  ///< the points' folders lie in it
};

}  // namespace bemcal::external
