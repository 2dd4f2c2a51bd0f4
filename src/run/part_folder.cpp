/// The folder of an unfinished run: its identity as text, safely on the disk, its lock,
/// and how far it is, for `status`.
/// Plain handling of files; the lock is flock's, which some network disks do not keep.
/// The logs' records are item_log's.
#include "run/part_folder.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace bemcal::run {
namespace {

constexpr const char* identity_name = "identity.txt";
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

[[noreturn]] void fail(const std::filesystem::path& path, const char* doing) {
    throw UserError(
        ExitCode::cannot_create,
        fmt::format("{}: cannot {}: {}", path.string(), doing, std::strerror(errno)));
}

void write_and_sync(const std::filesystem::path& path, const std::string& text) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) fail(path, "create the file");
    const bool good =
        ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
        ::fsync(file) == 0;
    const int error = errno;
    ::close(file);
    errno = error;
    if (!good) fail(path, "write");
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
        if (entry.path().extension() == ".log" && entry.file_size() > 0)
            last = std::max(last.value_or(fs::file_time_type::min()),
                            entry.last_write_time());
    if (!last) return {};
    const auto age = fs::file_time_type::clock::now() - *last;
    return fmt::format("  last item {} s ago\n",
                       std::chrono::duration_cast<std::chrono::seconds>(age).count());
}

}  // namespace

std::filesystem::path part_folder_of(const std::filesystem::path& output) {
    return output.string() + ".part";
}

std::string difference(const Identity& before, const Identity& now) {
    for (const auto& [key, value] : before)
        if (value_of(now, key) != value) return in_words(key, value, value_of(now, key));
    for (const auto& [key, value] : now)
        if (value_of(before, key).empty()) return in_words(key, "", value);
    return {};
}

Identity read_identity(const std::filesystem::path& folder) {
    std::ifstream in(folder / identity_name);
    if (!in)
        throw UserError(ExitCode::no_input, fmt::format("{}: cannot read it: {}",
                                                        (folder / identity_name).string(),
                                                        std::strerror(errno)));
    Identity identity;
    for (std::string line; std::getline(in, line);) {
        const std::size_t tab = line.find('\t');
        if (tab != std::string::npos)
            identity.emplace_back(line.substr(0, tab), line.substr(tab + 1));
    }
    return identity;
}

void write_identity(const std::filesystem::path& folder, const Identity& identity) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw UserError(
            ExitCode::cannot_create,
            fmt::format("{}: cannot create the folder: {}; choose another place with -o",
                        folder.string(), error.message()));
    std::string text;
    for (const auto& [key, value] : identity) text += fmt::format("{}\t{}\n", key, value);
    const auto temporary = folder / "identity.writing";
    write_and_sync(temporary, text);
    std::filesystem::rename(temporary, folder / identity_name);
}

FolderLock::FolderLock(const std::filesystem::path& folder)
    : file_(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    taken_ = file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

FolderLock::~FolderLock() {
    if (file_ >= 0) ::close(file_);
}

std::string part_status(const std::filesystem::path& folder) {
    const Identity identity = read_identity(folder);
    const store::LogContent logs = store::read_logs(folder);
    const bool is_running = FolderLock(folder).is_taken_by_another();
    std::map<int, StageDone> done = items_by_stage(logs);
    std::string text = is_running ? "not complete: a run is writing it now\n"
                                  : fmt::format(
                                        "not complete: `bemcal-batch run JOB -o {} "
                                        "--resume` goes on\n",
                                        (folder.parent_path() / folder.stem()).string());
    int stage = 0;
    for (const auto& [key, value] : identity)
        if (key.starts_with(stage_prefix))
            text += fmt::format("  {}: {}\n", key.substr(stage_prefix.size()),
                                stage_status(done[stage++], value));
    text += last_written(folder);
    if (logs.n_damaged > 0)
        text += fmt::format("  {} damaged record{} in the logs: to be done again\n",
                            logs.n_damaged, logs.n_damaged == 1 ? "" : "s");
    return text;
}

}  // namespace bemcal::run
