/// Where a job file is: the one that is named, or the quickstart that came with the
/// program; and where its other files are.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace bemcal::run {

/// A folder stands for the job of the same name inside it: jobs/office is
/// jobs/office/office.toml.
std::filesystem::path job_file(const std::filesystem::path& named);

/// A file that came with the program, jobs/... or scripts/..., of the first of these
/// folders that has it: the program's own and share/bemcal beside it, every folder above
/// it, then `shared` (the program's source or data folders).
std::optional<std::filesystem::path> find_beside(
    const std::filesystem::path& file, const std::vector<std::filesystem::path>& shared);

/// The quickstart's job, found so. Throws UserError that lists where it was looked for.
std::filesystem::path find_quickstart(const std::vector<std::filesystem::path>& shared);

}  // namespace bemcal::run
