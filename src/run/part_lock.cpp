/// A lock on a file `lock` in the folder. Whoever ends removes it while holding it, so
/// that one who got hold of a removed one begins anew.
/// Source: flock, by base's Lock. Where the disk keeps no locks there is a warning.
#include "run/part_lock.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "run/part_files.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

void make(const fs::path& folder) {
    if (fs::is_symlink(fs::symlink_status(folder)))
        refuse_place(
            fmt::format("{}: is a link, and a run's own folder cannot be one; remove "
                        "it, or choose another file with -o",
                        folder.string()));
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder, error))
        refuse_place(fmt::format(
            "{}: cannot create the folder: {}; choose another place with "
            "-o",
            folder.string(), error ? error.message() : "a file has that name"));
}

}  // namespace

void refuse_place(const std::string& message) {
    throw UserError(ExitCode::cannot_create, message);
}

PartLock::PartLock(const fs::path& folder) : folder_(folder) {
    do {
        make(folder);
        lock_ = std::make_unique<Lock>(folder / lock_name, O_RDWR | O_CREAT);
        if (!lock_->is_open() && lock_->error() == ENOENT) continue;  // removed meanwhile
        if (!lock_->is_open()) fail_at(folder / lock_name, "create it", lock_->error());
        if (lock_->is_taken_by_another())
            refuse_place(
                fmt::format("{}: another run is writing there now; wait for it, or "
                            "choose another file with -o",
                            folder.string()));
    } while (!lock_->is_still_there());
    if (!lock_->is_kept_by_disk())
        warning_ = fmt::format(
            "warning: {}: this disk keeps no locks ({}); nothing stops "
            "a second run from writing there at the same time",
            folder.string(), std::strerror(lock_->error()));
}

PartLock::~PartLock() {
    std::error_code ignored;
    const fs::path file = folder_ / lock_name;
    if (lock_->is_still_there() && fs::file_size(file, ignored) == 0 && !ignored)
        fs::remove(file, ignored);
    lock_.reset();
    fs::remove(folder_, ignored);  // only where it is empty
}

bool is_running(const fs::path& folder) {
    return Lock(folder / lock_name, O_RDONLY).is_held_by_somebody();
}

}  // namespace bemcal::run
