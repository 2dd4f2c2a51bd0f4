/// Effects as files that another program reads: what they are, and their hours.
#pragma once

#include "external/handed_file.hpp"
#include "study/hourly_simulator.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace bemcal::external {

/// In the point's folder: [[effect]] sections with a column of the other file each; and a
/// row for every hour of the periods.
constexpr const char* effects_file = "effects.toml";
constexpr const char* effects_hours_file = "effects.csv";
/// Where the program says, in a line each, what it could not take.
constexpr const char* left_out_file = "effects_left_out.txt";

/// None where there are no effects.
std::vector<HandedFile> files_of(std::span<const study::GivenEffect> effects);

/// What the program wrote there; empty where it wrote nothing.
std::vector<std::string> lines_left_out(const std::filesystem::path& folder);

}  // namespace bemcal::external
