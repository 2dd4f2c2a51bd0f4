/// Writes a file beside its place, syncs, closes and renames it, and syncs the folder.
/// Source: POSIX (open with O_EXCL and O_NOFOLLOW, fsync), renameat2 of Linux.
/// Leaves out what a file means, and locks.
#include "base/disk.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bemcal {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
constexpr std::size_t n_letters = 6;  ///< that make a name fresh

/// Closed without a look where an error is on its way already.
class Descriptor {
  public:
    explicit Descriptor(int file) : file_(file) {}
    ~Descriptor() {
        if (file_ >= 0) ::close(file_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    operator int() const { return file_; }

  private:
    int file_;
};

FileId id_of(const struct stat& state) {
    return {state.st_dev, state.st_ino};
}

bool is_of_place(int error) {
    for (const int each : {EACCES, EPERM, EROFS, ENOENT, ENOTDIR, EISDIR, EEXIST, ELOOP,
                           ENAMETOOLONG, EINVAL})
        if (error == each) return true;
    return false;
}

std::string error_in_words(int error) {
    return error == ENAMETOOLONG ? "the name is too long" : std::strerror(error);
}

[[noreturn]] void fail_reading(const fs::path& path, int error) {
    throw UserError(
        is_of_place(error) ? ExitCode::no_input : ExitCode::io,
        fmt::format("{}: cannot be read: {}", path.string(), error_in_words(error)));
}

std::string ending() {
    std::random_device random;
    std::string text;
    for (std::size_t k = 0; k < n_letters; ++k)
        text += letters[random() % letters.size()];
    return text;
}

/// 0 or errno. Some disks cannot say whether a name is taken in the same step.
int rename_to(const fs::path& from, const fs::path& to, Replace replace) {
    if (replace == Replace::no) {
        if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) ==
            0)
            return 0;
        if (errno != EINVAL && errno != ENOSYS) return errno;
        if (is_taken(to)) return EEXIST;
    }
    return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

std::string read_open(int file, const fs::path& path) {
    std::string bytes, block(1 << 16, '\0');
    for (;;) {
        const ssize_t n = ::read(file, block.data(), block.size());
        if (n == 0) return bytes;
        if (n < 0 && errno != EINTR) fail_reading(path, errno);
        if (n > 0) bytes.append(block, 0, static_cast<std::size_t>(n));
    }
}

}  // namespace

std::optional<FileId> file_id(const fs::path& path) {
    struct stat state{};
    if (::stat(path.c_str(), &state) != 0) return std::nullopt;
    return id_of(state);
}

bool is_taken(const fs::path& path) {
    struct stat state{};
    return ::lstat(path.c_str(), &state) == 0;
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void fail_at(const fs::path& path, const char* doing, int error) {
    throw UserError(
        is_of_place(error) ? ExitCode::cannot_create : ExitCode::io,
        fmt::format("{}: cannot {}: {}", path.string(), doing, error_in_words(error)));
}

std::string read_regular(const fs::path& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    struct stat state{};
    if (file < 0 || ::fstat(file, &state) != 0) fail_reading(path, errno);
    if (!S_ISREG(state.st_mode))
        throw UserError(ExitCode::data,
                        fmt::format("{}: is {}; expected a file", path.string(),
                                    S_ISDIR(state.st_mode) ? "a folder" : "no file"));
    return read_open(file, path);
}

void sync_folder(const fs::path& folder) {
    const Descriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (file < 0) {
        if (errno == EACCES) return;  // it may be written, but not be read
        fail_at(folder, "write to the disk", errno);
    }
    if (::fsync(file) != 0 && errno != EINVAL)
        fail_at(folder, "write to the disk", errno);
}

void write_all(int file, std::string_view bytes, const fs::path& path) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file, bytes.data(), bytes.size());
        if (n < 0 && errno != EINTR) fail_at(path, "write", errno);
        if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
    }
}

FreshFile::FreshFile(const fs::path& folder, const std::string& name) {
    do {
        path_ = folder / (name + "." + ending());
        file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                       0666);
    } while (file_ < 0 && errno == EEXIST);
    struct stat state{};
    if (file_ < 0 || ::fstat(file_, &state) != 0)
        fail_at(folder / name, "create the file", errno);
    id_ = id_of(state);
}

FreshFile::~FreshFile() {
    if (file_ >= 0) ::close(file_);
    if (!is_placed_) ::unlink(path_.c_str());
}

void FreshFile::write(std::string_view bytes) {
    write_all(file_, bytes, path_);
}

void FreshFile::sync_and_close() {
    if (::fsync(file_) != 0 && errno != EINVAL)
        fail_at(path_, "write to the disk", errno);
    if (::close(std::exchange(file_, -1)) != 0) fail_at(path_, "close", errno);
}

void FreshFile::move_to(const fs::path& place, Replace replace) {
    sync_and_close();
    if (file_id(path_) != id_) fail_at(path_, "find what was written", ENOENT);
    const int error = rename_to(path_, place, replace);
    if (error != 0) fail_at(place, "give it that name", error);
    is_placed_ = true;
    sync_folder(folder_of(place));
}

void replace_file(const fs::path& path, std::string_view text) {
    FreshFile fresh(folder_of(path), path.filename().string());
    fresh.write(text);
    if (read_regular(fresh.path()) != text)
        fail_at(path, "read back what was written", EIO);
    fresh.move_to(path, Replace::yes);
}

bool is_fresh_name(const std::string& file, const std::string& name) {
    return file.size() == name.size() + 1 + n_letters && file.starts_with(name + ".") &&
           file.find_first_not_of(letters, name.size() + 1) == std::string::npos;
}

}  // namespace bemcal
