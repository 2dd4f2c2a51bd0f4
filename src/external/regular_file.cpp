/// Opens without waiting and without following a link, looks what it is, and reads.
/// Source: POSIX (open with O_NONBLOCK and O_NOFOLLOW, fstat, pread).
#include "external/regular_file.hpp"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bemcal::external {
namespace {

namespace fs = std::filesystem;

/// A regular file that is open, or why there is none.
class RegularFile {
  public:
    explicit RegularFile(const fs::path& file)
        : file_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC)) {
        struct stat state{};
        if (file_ < 0)
            failure_ = errno == ELOOP ? "is a link" : "it has not been written";
        else if (::fstat(file_, &state) != 0 || !S_ISREG(state.st_mode))
            failure_ = "is no regular file";
        size_ = static_cast<std::size_t>(state.st_size);
    }
    ~RegularFile() {
        if (file_ >= 0) ::close(file_);
    }
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;

    const std::string& failure() const { return failure_; }
    std::size_t size() const { return size_; }
    /// From `first` on; less where it has become shorter.
    std::string part(std::size_t first, std::size_t n) const {
        std::string text(n, '\0');
        std::size_t done = 0;
        while (done < n) {
            const ssize_t got = ::pread(file_, text.data() + done, n - done,
                                        static_cast<off_t>(first + done));
            if (got == 0 || (got < 0 && errno != EINTR)) break;
            if (got > 0) done += static_cast<std::size_t>(got);
        }
        text.resize(done);
        return text;
    }

  private:
    int file_;
    std::size_t size_ = 0;
    std::string failure_;
};

}  // namespace

FileText text_of_file(const fs::path& file, double most_bytes) {
    const RegularFile open(file);
    if (!open.failure().empty()) return {{}, open.failure()};
    if (static_cast<double>(open.size()) > most_bytes)
        return {{},
                fmt::format("is larger than its limit: {} bytes, but output_limit = {:g} "
                            "MB",
                            open.size(), most_bytes / 1e6)};
    return {open.part(0, open.size()), {}};
}

std::string end_of_file(const fs::path& file, std::size_t most) {
    const RegularFile open(file);
    if (!open.failure().empty()) return {};
    const std::size_t n = std::min(open.size(), most);
    return open.part(open.size() - n, n);
}

}  // namespace bemcal::external
