/// The lock on a run's place, held from the first look to the end: of two runs that would
/// write there, one is refused.
#pragma once

#include "base/lock.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace bemcal::run {

/// Throws UserError (cannot_create): no result can be made there.
[[noreturn]] void refuse_place(const std::string& message);

class PartLock {
  public:
    /// Makes the folder where it is missing. Throws UserError (cannot_create) where that
    /// is not possible, the name is a link's, or another run holds it.
    explicit PartLock(const std::filesystem::path& folder);
    /// Removes the folder where nothing is left in it.
    ~PartLock();
    PartLock(const PartLock&) = delete;
    PartLock& operator=(const PartLock&) = delete;

    /// What a user should know where the disk keeps no locks; empty = it does.
    const std::string& warning() const { return warning_; }
    bool is_still_there() const { return lock_->is_still_there(); }

  private:
    std::filesystem::path folder_;
    std::unique_ptr<Lock> lock_;
    std::string warning_;
};

/// Whether a run writes there now.
bool is_running(const std::filesystem::path& folder);

}  // namespace bemcal::run
