/// Where a job file is: the one that is named, or the quickstart that came with the
/// program.
#pragma once

#include <filesystem>
#include <vector>

namespace bemcal::run {

/// A folder stands for the job of the same name inside it: jobs/office is
/// jobs/office/office.toml.
std::filesystem::path job_file(const std::filesystem::path& named);

/// jobs/quickstart of the first of these folders that has it: `shared` (the program's own
/// source or data folders), share/bemcal beside bin, and every folder above the program.
/// Throws UserError that lists where it was looked for.
std::filesystem::path find_quickstart(const std::vector<std::filesystem::path>& shared);

}  // namespace bemcal::run
