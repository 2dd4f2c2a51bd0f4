/// Where a job file is: the one that is named, or the quickstart that came with the
/// program; and where its scripts are.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace bemcal::run {

/// A folder stands for the job of the same name inside it: jobs/office is
/// jobs/office/office.toml.
std::filesystem::path job_file(const std::filesystem::path& named);

/// A script that came with the program, scripts/...: in share/bemcal beside the program,
/// else in `shared` (its source or data folders). In no other folder, as it is run: what
/// lies above the program, the job or the working folder may be anyone's.
std::optional<std::filesystem::path> find_script(
    const std::filesystem::path& script,
    const std::vector<std::filesystem::path>& shared);

/// The quickstart's job, of the first of these folders that has it: the program's own and
/// share/bemcal beside it, every folder above it, then `shared`. Throws UserError that
/// lists where it was looked for.
std::filesystem::path find_quickstart(const std::vector<std::filesystem::path>& shared);

}  // namespace bemcal::run
