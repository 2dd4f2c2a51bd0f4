/// Tells by its name and first bytes whether a run made a file.
/// Our own rules, without a source. Links and folders are never a run's. Whose record a
/// log holds is item_log's to say.
#include "run/part_files.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "run/progress_file.hpp"
#include "store/item_log.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_named = 3;

std::string begin_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::string bytes(8, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
    return bytes;
}

/// One of the two stays where one byte is damaged.
bool is_identity(const fs::path& path) {
    std::error_code error;
    if (fs::file_size(path, error) > (1U << 26) || error) return false;
    const std::string text = read_regular(path);
    return text.starts_with("version\t") || text.find("\nseal\t") != std::string::npos;
}

bool is_log(const fs::path& path) {
    const std::string begin = begin_of(path);
    return begin.empty() || begin ==
                                "\x89"
                                "bemitem";
}

bool is_left_by_writer(const std::string& name) {
    return is_fresh_name(name, identity_name) || is_fresh_name(name, result_name);
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end;
         at.increment(error))
        files.push_back(at->path());
    if (error && error != std::errc::no_such_file_or_directory)
        fail_at(folder, "read the folder", error.value());
    std::ranges::sort(files);
    return files;
}

/// Beside a run's identity a log that was damaged is still a log.
bool is_ours(const fs::path& file, bool has_identity) {
    const std::string name = file.filename().string();
    if (!fs::is_regular_file(fs::symlink_status(file))) return false;
    if (name == identity_name) return has_identity;
    if (name == progress_name) return is_progress_file(file);
    if (store::is_log_name(name)) return has_identity || is_log(file);
    return is_left_by_writer(name);
}

bool is_lock(const fs::path& file) {
    return file.filename() == lock_name && fs::is_regular_file(fs::symlink_status(file));
}

}  // namespace

PartFiles part_files(const fs::path& folder) {
    PartFiles found;
    const std::vector<fs::path> files = files_in(folder);
    const fs::path identity = folder / identity_name;
    found.has_identity =
        fs::is_regular_file(fs::symlink_status(identity)) && is_identity(identity);
    for (const fs::path& file : files) {
        if (is_lock(file)) continue;
        const bool is_one = is_ours(file, found.has_identity);
        (is_one ? found.ours : found.foreign).push_back(file);
        found.has_logs =
            found.has_logs || (is_one && store::is_log_name(file.filename().string()));
    }
    return found;
}

std::vector<std::string> remove_part_files(const fs::path& folder,
                                           const std::vector<fs::path>& kept) {
    std::vector<std::string> troubles;
    for (const fs::path& file : part_files(folder).ours) {
        std::error_code error;
        if (std::ranges::find(kept, file) == kept.end()) fs::remove(file, error);
        if (error)
            troubles.push_back(
                fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
    }
    return troubles;
}

std::string names_of(const std::vector<fs::path>& files) {
    std::string text;
    for (std::size_t k = 0; k < std::min(files.size(), most_named); ++k)
        text += (k > 0 ? ", " : "") + files[k].filename().string();
    if (files.size() > most_named)
        text += fmt::format(" and {} more", files.size() - most_named);
    return text;
}

}  // namespace bemcal::run
