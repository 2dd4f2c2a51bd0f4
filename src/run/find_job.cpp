/// Where a job file is: the one that is named, or the quickstart beside the program,
/// beside its installation, or in a folder above it.
/// Plain search of files (/proc/self/exe, so Linux only). It does not read the job, nor
/// look below a folder.
#include "run/find_job.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

/// Beside the program, installed beside it, in the folders above it, then the built-in
/// ones.
std::vector<fs::path> candidates(const std::vector<fs::path>& shared) {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    std::vector<fs::path> folders;
    if (!error) {
        folders.push_back(program.parent_path());
        folders.push_back(program.parent_path().parent_path() / "share" / "bemcal");
        for (fs::path above = program.parent_path(); above.has_relative_path();
             above = above.parent_path())
            folders.push_back(above.parent_path());
    }
    folders.insert(folders.end(), shared.begin(), shared.end());
    return folders;
}

}  // namespace

fs::path job_file(const fs::path& named) {
    if (!fs::is_directory(named)) return named;
    const fs::path folder = fs::absolute(named).lexically_normal();
    const fs::path name =
        folder.has_filename() ? folder.filename() : folder.parent_path().filename();
    const fs::path job = named / (name.string() + ".toml");
    return !fs::exists(job) && fs::exists(named / "job.toml") ? named / "job.toml" : job;
}

std::optional<fs::path> find_beside(const fs::path& file,
                                    const std::vector<fs::path>& shared) {
    for (const fs::path& folder : candidates(shared))
        if (fs::exists(folder / file)) return folder / file;
    return std::nullopt;
}

fs::path find_quickstart(const std::vector<fs::path>& shared) {
    const fs::path job = fs::path("jobs") / "quickstart" / "quickstart.toml";
    if (const auto found = find_beside(job, shared)) return *found;
    std::string looked;
    for (const fs::path& folder : candidates(shared))
        looked += "\n  " + (folder / job).string();
    throw UserError(
        ExitCode::no_input,
        fmt::format("the quickstart's job is not where it is expected; name a job, or "
                    "put it at one of:{}",
                    looked));
}

}  // namespace bemcal::run
