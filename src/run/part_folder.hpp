/// The folder NAME.h5.part of an unfinished run: its identity, its plan, and the ranks'
/// item logs.
///
/// `identity.txt` says what the logs are answers to: program version, job, every input
/// file, every stage, and a seal by which damage to it is noticed. A run that resumes
/// must be identical in all of it; every record is marked with it. The folder is locked
/// while a run writes (part_lock.hpp).
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

/// One line for everything that must be the same when a run resumes.
std::string hash_of(const Identity& identity);
/// The mark of the run's records.
store::RunMark mark_of(const Identity& identity);

struct StoredIdentity {
    Identity entries;
    bool is_sound = false;  ///< the seal is there and holds
};

/// Names the first difference in words; empty = none.
std::string difference(const Identity& before, const Identity& now);

/// Throws UserError where the file is missing or unreadable.
StoredIdentity read_identity(const std::filesystem::path& folder);

/// On the disk when it returns. Throws UserError.
void write_identity(const std::filesystem::path& folder, const Identity& identity);

/// Whether that identity stands there still.
bool has_identity(const std::filesystem::path& folder, const Identity& identity);

/// How far an unfinished run is, as text for `status`. Throws UserError (data) where its
/// identity is missing or damaged.
std::string part_status(const std::filesystem::path& folder);

}  // namespace bemcal::run
