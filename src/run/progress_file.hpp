/// The progress of a run for other programs: NAME.part/progress.txt holds the line that
/// rank 0 shows, so that `status` tells it from another shell.
///
/// It is a courtesy: where it cannot be written the run goes on without. It always has
/// the same length and a checksum, so that a reader takes no half of two lines.
#pragma once

#include <filesystem>
#include <string>

namespace bemcal::run {

constexpr const char* progress_name = "progress.txt";

class ProgressFile {
  public:
    ProgressFile() = default;  ///< of a rank that writes none
    /// Makes it; what no run made under that name is left as it is.
    explicit ProgressFile(const std::filesystem::path& folder);
    ~ProgressFile();  ///< removes it
    ProgressFile(const ProgressFile&) = delete;
    ProgressFile& operator=(const ProgressFile&) = delete;

    /// One line, cut where it is very long. Not told to the disk: a few microseconds.
    void write(const std::string& text);

  private:
    std::filesystem::path path_;
    int file_ = -1;
};

/// Whether a run made the file, or nobody has anything to lose in it: it is empty.
bool is_progress_file(const std::filesystem::path& path);

/// The line of the run that writes in that folder; empty = none, or just being written.
std::string read_progress(const std::filesystem::path& folder);

}  // namespace bemcal::run
