/// Writes a run's progress into one small file of fixed length, over and over, and reads
/// it.
/// Our own form, without a source: a mark with a checksum, the line, blanks. Leaves out
/// any history.
#include "run/progress_file.hpp"

#include "base/hash.hpp"
#include "base/terminal.hpp"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "bemcal progress ";
constexpr std::size_t digits = 16;       ///< of a 64-bit checksum
constexpr std::size_t text_bytes = 478;  ///< the whole file is half a kibibyte
constexpr std::size_t head_bytes = mark.size() + digits + 1;
constexpr std::size_t file_bytes = head_bytes + text_bytes + 1;

std::string content_of(const std::string& text) {
    std::string line = in_one_line(text);
    line.resize(text_bytes, ' ');
    return fmt::format("{}{:016x}\n{}\n", mark, checksum64(line.data(), line.size()),
                       line);
}

/// Neither a link nor a pipe is followed or waited for.
std::string bytes_of(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return {};
    std::string bytes(file_bytes + 1, '\0');
    const auto n = ::pread(file, bytes.data(), bytes.size(), 0);
    ::close(file);
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    return bytes;
}

}  // namespace

ProgressFile::ProgressFile(const fs::path& folder) : path_(folder / progress_name) {
    if (is_progress_file(path_)) ::unlink(path_.c_str());  // an earlier run's
    file_ =
        ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

ProgressFile::~ProgressFile() {
    if (file_ < 0) return;
    struct stat mine{}, there{};
    const bool is_there = ::fstat(file_, &mine) == 0 &&
                          ::lstat(path_.c_str(), &there) == 0 &&
                          mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
    ::close(file_);
    if (is_there) ::unlink(path_.c_str());
}

void ProgressFile::write(const std::string& text) {
    if (file_ < 0) return;
    const std::string content = content_of(text);
    const auto n = ::pwrite(file_, content.data(), content.size(), 0);
    static_cast<void>(n);  // of a full disk the logs complain
}

bool is_progress_file(const fs::path& path) {
    struct stat there{};
    if (::lstat(path.c_str(), &there) != 0 || !S_ISREG(there.st_mode)) return false;
    if (there.st_size == 0) return true;  // of a run that ended before its first line
    return there.st_size == off_t{file_bytes} && bytes_of(path).starts_with(mark);
}

std::string read_progress(const fs::path& folder) {
    const std::string content = bytes_of(folder / progress_name);
    if (content.size() != file_bytes) return {};
    std::string text = content.substr(head_bytes, text_bytes);
    if (content != content_of(text)) return {};
    text.resize(text.find_last_not_of(' ') + 1);
    return text;
}

}  // namespace bemcal::run
