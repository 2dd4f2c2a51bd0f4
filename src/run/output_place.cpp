/// The place of the result before the first simulation: whether it may go on, start anew,
/// or must be refused, and the logs of the run that goes on.
/// Our own rules, without a source: version, job, files and stages must be the same.
/// Files that changed for single items of a stock are the stage's to tell.
#include "run/output_place.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"
#include "store/result_file.hpp"

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& message) {
    throw UserError(ExitCode::cannot_create, message);
}

/// Whether the job's complete result stands there.
bool is_done(const fs::path& output, const Identity& identity) {
    if (!fs::exists(output)) return false;
    const store::ResultFile result = store::read_result(output);
    const auto found = result.attributes.find("identity");
    return found != result.attributes.end() && found->second == hash_of(identity) &&
           result.complete;
}

void check_identity(const fs::path& folder, const Identity& identity) {
    const std::string change = difference(read_identity(folder), identity);
    if (!change.empty())
        refuse(fmt::format(
            "{}: cannot be resumed: {}; restore that, or start anew with --force",
            folder.string(), change));
}

void refuse_existing(const fs::path& output, const fs::path& folder) {
    if (fs::exists(output))
        refuse(fmt::format(
            "{}: exists already; overwrite with --force, or choose another file "
            "with -o",
            output.string()));
    if (fs::exists(folder / "identity.txt"))
        refuse(fmt::format(
            "{}: holds an unfinished run; go on with --resume, or start anew with "
            "--force",
            folder.string()));
}

/// Of an unfinished run, or beside a result of which items failed.
store::LogContent checked_logs(const fs::path& folder, const Identity& identity) {
    check_identity(folder, identity);
    return store::read_logs(folder);
}

/// Nothing of this job is there that could be gone on with.
void check_nothing_left(const fs::path& output, Existing existing) {
    if (existing == Existing::rerun_failed)
        refuse(
            fmt::format("{}: has no failed items beside it ({}), so that there is "
                        "nothing to do again",
                        output.string(), part_folder_of(output).string()));
    if (existing == Existing::resume && fs::exists(output))
        refuse(fmt::format(
            "{}: is the result of another job, version or data, so that there is "
            "nothing to resume; choose another file with -o, or overwrite with --force",
            output.string()));
}

}  // namespace

void refuse_running(const fs::path& output) {
    refuse(
        fmt::format("{}: another run is writing there now; wait for it, or choose "
                    "another file with -o",
                    part_folder_of(output).string()));
}

bool is_unfinished(const fs::path& output) {
    const fs::path folder = part_folder_of(output);
    return fs::exists(folder / "identity.txt") && !is_done(output, read_identity(folder));
}

std::string hash_of(const Identity& identity) {
    Hasher hasher;
    for (const auto& [key, value] : identity) {
        hasher.add(std::string_view(key));
        hasher.add(std::string_view(value));
    }
    return hasher.hex();
}

OutputPlace prepare_output(const fs::path& output, Existing existing,
                           const Identity& identity) {
    const fs::path folder = part_folder_of(output);
    OutputPlace place;
    if (fs::is_directory(output) || !output.has_filename())
        refuse(fmt::format("{}: is a folder; expected a file, like {}", output.string(),
                           (output / "result.h5").string()));
    if (fs::exists(folder) && FolderLock(folder).is_taken_by_another())
        refuse_running(output);
    if (existing == Existing::refuse) refuse_existing(output, folder);
    const bool has_part = fs::exists(folder / "identity.txt");
    place.is_complete = existing == Existing::resume && is_done(output, identity);
    if (place.is_complete) return place;
    const bool goes_on =
        existing == Existing::resume || existing == Existing::rerun_failed;
    if (goes_on && has_part) {
        place.logs = checked_logs(folder, identity);
        return place;
    }
    check_nothing_left(output, existing);
    std::error_code ignored;  // write_identity says what is wrong with the place
    fs::remove_all(folder, ignored);
    write_identity(folder, identity);
    return place;
}

}  // namespace bemcal::run
