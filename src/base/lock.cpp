/// flock on a file of its own.
/// Source: flock(2). On NFS it is the server's byte-range lock; some disks keep none, and
/// then there is an error, which is the caller's to tell.
#include "base/lock.hpp"

#include "base/disk.hpp"

#include <cerrno>
#include <chrono>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bemcal {

Lock::Lock(const std::filesystem::path& path, int flags)
    : path_(path),
      file_(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666)),
      error_(file_ < 0 ? errno : 0) {}

Lock::~Lock() {
    if (file_ >= 0) ::close(file_);
}

/// 0 or errno; what the disk cannot do is kept.
int Lock::flock(int operation) {
    if (file_ < 0) return error_;
    int error = 0;
    do {
        error = ::flock(file_, operation) == 0 ? 0 : errno;
    } while (error == EINTR);
    if (error != EWOULDBLOCK) error_ = error;
    return error;
}

bool Lock::is_taken_by_another() {
    for (int tries = 0; tries < 10; ++tries) {
        if (flock(LOCK_EX | LOCK_NB) != EWOULDBLOCK) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
}

void Lock::wait() {
    flock(LOCK_EX);
}

bool Lock::is_held_by_somebody() {
    const bool is_held = flock(LOCK_SH | LOCK_NB) == EWOULDBLOCK;
    if (!is_held && file_ >= 0) flock(LOCK_UN);
    return is_held;
}

bool Lock::is_still_there() const {
    struct stat mine{}, there{};
    return file_ >= 0 && ::fstat(file_, &mine) == 0 &&
           ::lstat(path_.c_str(), &there) == 0 && mine.st_dev == there.st_dev &&
           mine.st_ino == there.st_ino;
}

}  // namespace bemcal
