/// The folder NAME.h5.part of an unfinished run: its identity, its plan, and the ranks'
/// item logs.
///
/// `identity.txt` says what the logs are answers to: program version, job, every input
/// file, every stage. A run that resumes must be identical in all of it. It is locked
/// while a run writes.
#pragma once

#include "store/item_log.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::run {

/// What logs are answers to, in order: "version" = "0.1.0", "file weather.epw" = its
/// hash, "stage office/screening" = "2000 items".
using Identity = std::vector<std::pair<std::string, std::string>>;

std::filesystem::path part_folder_of(const std::filesystem::path& output);

/// Names the first difference in words; empty = none.
std::string difference(const Identity& before, const Identity& now);

/// Throws UserError where the file is missing or unreadable.
Identity read_identity(const std::filesystem::path& folder);

/// Creates the folder with its identity, safely on the disk when it returns. Throws
/// UserError.
void write_identity(const std::filesystem::path& folder, const Identity& identity);

/// Held while a run writes into a folder.
class FolderLock {
  public:
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    bool is_taken_by_another() const { return taken_; }

  private:
    int file_ = -1;
    bool taken_ = false;
};

/// How far an unfinished run is, as text for `status`.
std::string part_status(const std::filesystem::path& folder);

}  // namespace bemcal::run
