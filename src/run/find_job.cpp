/// Where a job file is: the one that is named, or the quickstart beside the program,
/// beside its installation, or in a folder above it; and a script, not in one above.
/// Plain search of files (/proc/self/exe, so Linux only). It does not read the job, nor
/// look below a folder.
#include "run/find_job.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

fs::path own_folder() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error).parent_path();
}

fs::path installed_beside(const fs::path& folder) {
    return folder.parent_path() / "share" / "bemcal";
}

/// Beside the program, installed beside it, in the folders above it, then the built-in
/// ones.
std::vector<fs::path> candidates(const std::vector<fs::path>& shared) {
    const fs::path own = own_folder();
    std::vector<fs::path> folders;
    if (!own.empty()) {
        folders = {own, installed_beside(own)};
        for (fs::path above = own; above.has_relative_path(); above = above.parent_path())
            folders.push_back(above.parent_path());
    }
    folders.insert(folders.end(), shared.begin(), shared.end());
    return folders;
}

std::optional<fs::path> first_with(const fs::path& file,
                                   const std::vector<fs::path>& folders) {
    for (const fs::path& folder : folders)
        if (fs::exists(folder / file)) return folder / file;
    return std::nullopt;
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

std::optional<fs::path> find_script(const fs::path& script,
                                    const std::vector<fs::path>& shared) {
    const fs::path own = own_folder();
    std::vector<fs::path> folders;
    if (!own.empty()) folders.push_back(installed_beside(own));
    folders.insert(folders.end(), shared.begin(), shared.end());
    return first_with(script, folders);
}

fs::path find_quickstart(const std::vector<fs::path>& shared) {
    const fs::path job = fs::path("jobs") / "quickstart" / "quickstart.toml";
    if (const auto found = first_with(job, candidates(shared))) return *found;
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
