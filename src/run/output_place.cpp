/// The place of the result before the first simulation: whether it may go on, start anew,
/// or must be refused, and the logs of the run that goes on.
/// Our own rules, without a source: version, job, files and stages must be the same.
/// Files that changed for single items of a stock are the stage's to tell.
#include "run/output_place.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"
#include "run/part_files.hpp"
#include "store/result_file.hpp"

#include <utility>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

/// Whether the result says that it is this job's.
bool is_of(const store::ResultFile& result, const std::string& identity_hash) {
    const auto found = result.attributes.find("identity");
    return found != result.attributes.end() && found->second == identity_hash;
}

/// Whether the job's result stands there, damaged or not.
bool has_result(const fs::path& output, const std::string& identity_hash) {
    return fs::exists(output) && is_of(store::read_head(output), identity_hash);
}

/// Whether the job's complete and sound result stands there.
bool is_done(const fs::path& output, const std::string& identity_hash) {
    return has_result(output, identity_hash) &&
           store::is_sound(store::read_result(output));
}

void refuse_folder(const fs::path& output) {
    if (fs::is_directory(output) || !output.has_filename())
        refuse_place(fmt::format("{}: is a folder; expected a file, like {}",
                                 output.string(), (output / "result.h5").string()));
}

void refuse_result(const fs::path& output) {
    if (is_taken(output))
        refuse_place(fmt::format(
            "{}: exists already; overwrite with --force, or choose another file "
            "with -o",
            output.string()));
}

void refuse_unfinished(const fs::path& folder, const PartFiles& files) {
    if (files.has_run())
        refuse_place(fmt::format(
            "{}: holds an unfinished run; go on with --resume, or start anew with "
            "--force",
            folder.string()));
}

/// A folder of somebody else's is left as it is.
void refuse_foreign(const fs::path& folder, const PartFiles& files) {
    if (!files.foreign.empty() && !files.has_run())
        refuse_place(
            fmt::format("{}: holds what no run made ({}); move it away, or choose "
                        "another file with -o",
                        folder.string(), names_of(files.foreign)));
}

/// A version that can be read and is another is refused even so.
std::string other_version(const StoredIdentity& stored, const Identity& identity) {
    for (const auto& entry : stored.entries)
        if (entry.first == "version") return difference({entry}, {identity.at(0)});
    return {};
}

/// Where identity.txt cannot tell, the records do: each is marked with its run.
void check_damaged(const fs::path& folder, const StoredIdentity& stored,
                   const Identity& identity, OutputPlace& place) {
    const std::string file = (folder / identity_name).string();
    if (is_taken(file)) read_regular(file);  // a folder is refused
    if (const std::string change = other_version(stored, identity); !change.empty())
        refuse_place(
            fmt::format("{}: is damaged, or was changed: {}; where it is only damaged, "
                        "remove it and go on with --resume",
                        file, change));
    if (place.logs.records.empty())
        refuse_place(
            fmt::format("{}: is missing or damaged, and no record in the logs is this "
                        "job's; restore it, or start anew with --force",
                        file));
    place.remarks.push_back(file +
                            ": is missing or damaged; the records in the logs "
                            "tell by themselves that they are this job's");
    write_identity(folder, identity);
}

/// Of an unfinished run, or beside a result of which items failed.
void go_on(const fs::path& folder, const PartFiles& files, const Identity& identity,
           OutputPlace& place) {
    const StoredIdentity stored =
        files.has_identity ? read_identity(folder) : StoredIdentity{};
    const std::string change = difference(stored.entries, identity);
    if (stored.is_sound && !change.empty())
        refuse_place(fmt::format(
            "{}: cannot be resumed: {}; restore that, or start anew with --force",
            folder.string(), change));
    place.logs = store::read_logs(folder, mark_of(identity));
    if (!stored.is_sound) check_damaged(folder, stored, identity, place);
    if (place.logs.n_foreign > 0)
        place.remarks.push_back(fmt::format(
            "refused: {} records of another run, in {} of {}", place.logs.n_foreign,
            names_of(place.logs.foreign), folder.string()));
}

/// Nothing of this job is there that could be gone on with.
void check_nothing_left(const fs::path& output, Existing existing,
                        const std::string& identity_hash) {
    if (existing == Existing::rerun_failed)
        refuse_place(
            fmt::format("{}: has no failed items beside it ({}), so that there is "
                        "nothing to do again",
                        output.string(), part_folder_of(output).string()));
    if (existing != Existing::resume || !fs::exists(output)) return;
    if (is_of(store::read_head(output), identity_hash))
        refuse_place(
            fmt::format("{}: is damaged; do it again with --force, or choose another "
                        "file with -o",
                        output.string()));
    refuse_place(fmt::format(
        "{}: is the result of another job, version or data, so that there is "
        "nothing to resume; choose another file with -o, or overwrite with --force",
        output.string()));
}

void start_anew(const fs::path& folder, const PartFiles& files, const Identity& identity,
                OutputPlace& place) {
    for (std::string& trouble : remove_part_files(folder))
        place.remarks.push_back(std::move(trouble));
    if (!files.foreign.empty())
        place.remarks.push_back(fmt::format("left as it is, as no run made it: {} in {}",
                                            names_of(files.foreign), folder.string()));
    write_identity(folder, identity);
}

}  // namespace

bool is_unfinished(const fs::path& output) {
    const fs::path folder = part_folder_of(output);
    const PartFiles files = part_files(folder);
    if (!files.has_run()) return false;
    const StoredIdentity identity =
        files.has_identity ? read_identity(folder) : StoredIdentity{};
    if (!identity.is_sound) return !fs::exists(output);
    return !has_result(output, hash_of(identity.entries));
}

OutputPlace prepare_output(const fs::path& output, Existing existing,
                           const Identity& identity) {
    refuse_folder(output);
    if (existing == Existing::refuse) refuse_result(output);
    OutputPlace place;
    const fs::path folder = part_folder_of(output);
    const auto is_complete = [&] {
        return existing == Existing::resume && is_done(output, hash_of(identity));
    };
    // A result that is whole needs no folder beside it, which may be one to read only.
    if (!is_taken(folder)) place.is_complete = is_complete();
    if (place.is_complete) return place;
    place.lock = std::make_unique<PartLock>(folder);
    if (existing == Existing::refuse) refuse_result(output);
    place.is_complete = is_complete();
    if (place.is_complete) return place;
    const PartFiles files = part_files(folder);
    if (existing == Existing::refuse) refuse_unfinished(folder, files);
    refuse_foreign(folder, files);
    place.replace = is_taken(output) ? Replace::yes : Replace::no;
    const bool goes_on =
        existing == Existing::resume || existing == Existing::rerun_failed;
    if (goes_on && files.has_run()) {
        go_on(folder, files, identity, place);
        return place;
    }
    check_nothing_left(output, existing, hash_of(identity));
    start_anew(folder, files, identity, place);
    return place;
}

}  // namespace bemcal::run
