/// The folder of an unfinished run: its identity as text, safely on the disk, and how far
/// it is, for `status`.
/// Plain handling of files, without a source. The lock is part_lock's, the logs' records
/// are item_log's.
#include "run/part_folder.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/terminal.hpp"
#include "run/part_files.hpp"
#include "run/part_lock.hpp"
#include "run/progress_file.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

constexpr const char* seal_key = "seal";
constexpr std::string_view stage_prefix = "stage ", file_prefix = "file ";

/// What a changed entry means to a reader.
std::string in_words(const std::string& key, const std::string& before,
                     const std::string& now) {
    if (key == "version")
        return fmt::format("it was begun by version {}, this is version {}", before, now);
    if (now.empty()) return fmt::format("{} was part of it and is no longer", key);
    if (before.empty()) return fmt::format("{} was not part of it", key);
    if (key.starts_with(file_prefix))
        return fmt::format("{} has changed since", key.substr(file_prefix.size()));
    return fmt::format("{} was {} and is {} now", key, before, now);
}

std::string value_of(const Identity& identity, const std::string& key) {
    const auto found = std::ranges::find(identity, key, &Identity::value_type::first);
    return found == identity.end() ? std::string() : found->second;
}

/// As it is written: a line for each entry, whatever names hold.
Identity in_lines(const Identity& identity) {
    Identity lines;
    for (const auto& [key, value] : identity)
        lines.emplace_back(in_one_line(key), in_one_line(value));
    return lines;
}

std::string text_of(const Identity& identity) {
    const Identity lines = in_lines(identity);
    std::string text;
    for (const auto& [key, value] : lines) text += fmt::format("{}\t{}\n", key, value);
    return text + fmt::format("{}\t{}\n", seal_key, hash_of(lines));
}

struct StageDone {
    int n_items = 0, n_failed = 0;  ///< an item with failed points counts as failed
    std::string reason;             ///< the first
};

std::map<int, StageDone> items_by_stage(const store::LogContent& logs) {
    std::map<int, StageDone> stages;
    for (const auto& record : logs.records) {
        StageDone& stage = stages[record.key.stage];
        ++stage.n_items;
        const auto answer = store::unpack(record.packed.data(), record.packed.size());
        if (answer.error.empty() && answer.failures.empty()) continue;
        if (stage.n_failed++ == 0)
            stage.reason =
                answer.error.empty() ? answer.failures[0].reason : answer.error;
    }
    return stages;
}

/// \param items  "16 items": of the first round
std::string stage_status(const StageDone& done, const std::string& items) {
    const int n_first = std::atoi(items.c_str());
    std::string text = done.n_items <= n_first
                           ? fmt::format("{} of {} done", done.n_items, items)
                           : fmt::format("{} items done, {} of them in its first round",
                                         done.n_items, n_first);
    if (done.n_failed > 0)
        text +=
            fmt::format("; with failures: {}, the first: {}", done.n_failed, done.reason);
    return text;
}

/// "3 s ago": the last item of any rank; empty = none yet.
std::string last_written(const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    std::optional<fs::file_time_type> last;
    for (const auto& entry : fs::directory_iterator(folder))
        if (store::is_log_name(entry.path().filename().string()) && entry.file_size() > 0)
            last = std::max(last.value_or(fs::file_time_type::min()),
                            entry.last_write_time());
    if (!last) return {};
    const auto age = fs::file_time_type::clock::now() - *last;
    return fmt::format("  last item {} s ago\n",
                       std::chrono::duration_cast<std::chrono::seconds>(age).count());
}

[[noreturn]] void fail_status(const std::filesystem::path& folder, const char* what) {
    throw UserError(
        ExitCode::data,
        fmt::format("{}: {}: how far the run is cannot be told; --resume with its job "
                    "goes on with the records that are its own",
                    (folder / identity_name).string(), what));
}

}  // namespace

std::filesystem::path part_folder_of(const std::filesystem::path& output) {
    return output.string() + ".part";
}

std::string hash_of(const Identity& identity) {
    Hasher hasher;
    for (const auto& [key, value] : identity) {
        hasher.add(std::string_view(key));
        hasher.add(std::string_view(value));
    }
    return hasher.hex();
}

store::RunMark mark_of(const Identity& identity) {
    const std::string hash = hash_of(in_lines(identity));
    return checksum64(hash.data(), hash.size());
}

std::string difference(const Identity& before, const Identity& now) {
    const Identity lines = in_lines(now);
    for (const auto& [key, value] : in_lines(before))
        if (value_of(lines, key) != value)
            return in_words(key, value, value_of(lines, key));
    for (const auto& [key, value] : lines)
        if (value_of(before, key).empty()) return in_words(key, "", value);
    return {};
}

StoredIdentity read_identity(const std::filesystem::path& folder) {
    std::istringstream in(read_regular(folder / identity_name));
    StoredIdentity stored;
    std::string seal;
    for (std::string line; std::getline(in, line);) {
        const std::size_t tab = std::min(line.find('\t'), line.size());
        const std::string key = line.substr(0, tab);
        const std::string value = tab < line.size() ? line.substr(tab + 1) : "";
        if (key == seal_key)
            seal = value;
        else
            stored.entries.emplace_back(key, value);
    }
    stored.is_sound = seal == hash_of(stored.entries);
    return stored;
}

void write_identity(const std::filesystem::path& folder, const Identity& identity) {
    replace_file(folder / identity_name, text_of(identity));
}

bool has_identity(const std::filesystem::path& folder, const Identity& identity) {
    try {
        return read_regular(folder / identity_name) == text_of(identity);
    } catch (const UserError&) {
        return false;
    }
}

std::string part_status(const std::filesystem::path& folder) {
    if (!part_files(folder).has_identity) fail_status(folder, "is missing or damaged");
    const StoredIdentity identity = read_identity(folder);
    if (!identity.is_sound) fail_status(folder, "is damaged");
    const store::LogContent logs = store::read_logs(folder, mark_of(identity.entries));
    std::map<int, StageDone> done = items_by_stage(logs);
    const bool is_going_on = is_running(folder);
    const std::string now = is_going_on ? read_progress(folder) : "";
    std::string text =
        is_going_on
            ? "not complete: a run is writing it now\n"
            : fmt::format("not complete: `bemcal-batch run JOB -o {} --resume` goes on\n",
                          (folder.parent_path() / folder.stem()).string());
    int stage = 0;
    for (const auto& [key, value] : identity.entries)
        if (key.starts_with(stage_prefix))
            text += fmt::format("  {}: {}\n", key.substr(stage_prefix.size()),
                                stage_status(done[stage++], value));
    text += last_written(folder);
    if (!now.empty()) text += fmt::format("  now {}\n", now);
    if (logs.n_damaged > 0)
        text += fmt::format("  {} damaged record{} in the logs: to be done again\n",
                            logs.n_damaged, logs.n_damaged == 1 ? "" : "s");
    if (logs.n_foreign > 0)
        text += fmt::format("  records of another run, which are refused: {}, in {}\n",
                            logs.n_foreign, names_of(logs.foreign));
    return text;
}

}  // namespace bemcal::run
