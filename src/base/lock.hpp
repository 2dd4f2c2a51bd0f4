/// A lock on a file or folder, kept by the system for as long as it is held: it ends with
/// the program, however that ends.
#pragma once

#include <filesystem>
#include <string>

namespace bemcal {

class Lock {
  public:
    /// Of what is there. Opens it, and does not follow a link.
    /// \param flags  open's: O_RDONLY, or O_RDWR | O_CREAT for a file that may be new
    Lock(const std::filesystem::path& path, int flags);
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

    bool is_open() const { return file_ >= 0; }
    int error() const { return error_; }  ///< of opening or locking; 0 = none

    /// Tries for a moment, as somebody who only looks holds it no longer.
    /// \return whether another has it; where the disk keeps no locks, nobody has
    bool is_taken_by_another();
    /// Waits for as long as it takes.
    void wait();
    /// Whether somebody has it now. Takes it for no longer than the question.
    bool is_held_by_somebody();
    bool is_kept_by_disk() const { return error_ == 0; }
    /// Whether the path still stands for what was locked.
    bool is_still_there() const;

  private:
    int flock(int operation);

    std::filesystem::path path_;
    int file_ = -1;
    int error_ = 0;
};

}  // namespace bemcal
