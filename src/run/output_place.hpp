/// The place of the result before the first simulation: what is there already, and
/// whether it may go on, start anew, or must be refused. Rank 0 only.
#pragma once

#include "run/part_folder.hpp"
#include "store/item_log.hpp"

#include <filesystem>

namespace bemcal::run {

/// What to do about a result, or an unfinished one, that is there already. rerun_failed:
/// keeps the items that succeeded, does the others again, and replaces the result.
enum class Existing { refuse, force, resume, rerun_failed };

struct OutputPlace {
    bool is_complete = false;  ///< the same job's result is there: nothing to do
    store::LogContent logs;    ///< of the run that is resumed
};

/// Makes the part folder with its identity. Throws UserError where something is in the
/// way, or the logs belong to another job, version or data; names the difference.
OutputPlace prepare_output(const std::filesystem::path& output, Existing existing,
                           const Identity& identity);

/// Whether a run of that output has items to do: a part folder without, or not of, a
/// complete result.
bool is_unfinished(const std::filesystem::path& output);

/// Throws UserError: another run holds the part folder.
[[noreturn]] void refuse_running(const std::filesystem::path& output);

/// One line for everything that must be the same when a run resumes.
std::string hash_of(const Identity& identity);

}  // namespace bemcal::run
