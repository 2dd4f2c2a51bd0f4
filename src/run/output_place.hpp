/// The place of the result before the first simulation: what is there already, and
/// whether it may go on, start anew, or must be refused. Rank 0 only.
#pragma once

#include "base/disk.hpp"
#include "run/part_folder.hpp"
#include "run/part_lock.hpp"
#include "store/item_log.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace bemcal::run {

/// What to do about a result, or an unfinished one, that is there already. rerun_failed:
/// keeps the items that succeeded, does the others again, and replaces the result.
enum class Existing { refuse, force, resume, rerun_failed };

struct OutputPlace {
    std::unique_ptr<PartLock> lock;    ///< held until the place is given up
    bool is_complete = false;          ///< the same job's result is there: nothing to do
    store::LogContent logs;            ///< of the run that is resumed
    Replace replace = Replace::no;     ///< whether a result that is there may go
    std::vector<std::string> remarks;  ///< for the user
};

/// Locks the place and makes the part folder with its identity. Throws UserError where
/// something is in the way, another run holds it, or the logs belong to another job,
/// version or data; names the difference.
OutputPlace prepare_output(const std::filesystem::path& output, Existing existing,
                           const Identity& identity);

/// Whether a run of that output has items to do: a part folder without, or not of, a
/// complete result. One that is damaged is complete here: that it is damaged is told.
bool is_unfinished(const std::filesystem::path& output);

}  // namespace bemcal::run
