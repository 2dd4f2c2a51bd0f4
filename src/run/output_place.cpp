#include "run/output_place.hpp"

#include "base/hash.hpp"

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& message) {
    throw UserError(ExitCode::cannot_create, message);
}

/// Whether a finished result of the same job stands there; another one's must not be
/// touched.
bool is_same_result(const fs::path& output, const Identity& identity) {
    const store::ResultFile result = store::read_result(output);
    const auto found = result.attributes.find("identity");
    if (found != result.attributes.end() && found->second == hash_of(identity))
        return result.complete;
    refuse(fmt::format(
        "{}: is the result of another job, version or data, so that there is "
        "nothing to resume; choose another file with -o, or overwrite with --force",
        output.string()));
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

void refuse_running(const fs::path& folder) {
    if (fs::exists(folder) && FolderLock(folder).is_taken_by_another())
        refuse(fmt::format(
            "{}: another run is writing there now; wait for it, or choose another "
            "file with -o",
            folder.string()));
}

}  // namespace

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
    refuse_running(folder);
    if (existing == Existing::refuse) refuse_existing(output, folder);
    if (existing == Existing::resume && fs::exists(folder / "identity.txt")) {
        check_identity(folder, identity);
        place.logs = store::read_logs(folder);
        return place;
    }
    if (existing == Existing::resume && fs::exists(output)) {
        place.is_complete = is_same_result(output, identity);
        if (place.is_complete) return place;
    }
    std::error_code ignored;  // write_identity says what is wrong with the place
    fs::remove_all(folder, ignored);
    write_identity(folder, identity);
    return place;
}

}  // namespace bemcal::run
