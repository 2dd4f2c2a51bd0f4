/// All stages of a job, over ranks and threads, to one result file; safe against signals,
/// time limits, crashes and full disks.
///
/// Every finished item is in a rank's log before it counts (store/item_log.hpp). The
/// result is written once, at the end, from the answers in item order; then the logs are
/// removed. It knows stages, not jobs: run_job.hpp makes the one from the other.
#pragma once

#include "base/error.hpp"
#include "run/comm.hpp"
#include "run/output_names.hpp"
#include "run/output_place.hpp"
#include "run/part_folder.hpp"
#include "store/result_file.hpp"
#include "study/stage.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::run {

/// All that is to be done, whatever it was read from.
struct Work {
    std::vector<std::unique_ptr<study::Stage>> stages;
    std::shared_ptr<const void> data;  ///< what the stages refer to; may be empty
    Identity identity;                 ///< execute adds the stages
    store::ResultFile frame;           ///< what is known before the first simulation
    /// More failed points than this and the batch has failed.
    double max_failed_share = 1;
};

struct ExecuteOptions {
    std::filesystem::path output;
    Existing existing = Existing::refuse;
    int n_threads = 0;        ///< 0 = see plan_threads
    double item_seconds = 0;  ///< an item that takes longer is unfinished; 0 = no limit
    /// Rank 0's time to begin no more items, as after a signal; none: no limit.
    std::optional<std::chrono::steady_clock::time_point> stop_at = std::nullopt;
    std::function<void(const std::string&)> say;  ///< rank 0: one line for the user
    /// rank 0: before the first stage with the frame, then after each with its datasets
    /// only
    std::function<void(const store::ResultFile&)> on_stage;
};

struct Outcome {
    /// more_to_do after a signal or `stop_at`; data: too many points failed; not_reached:
    /// a stage missed its target. The same on all ranks.
    ExitCode code = ExitCode::ok;
    std::string hash;                     ///< rank 0, where a result was written
    bool is_complete_already = false;     ///< nothing was to do
    std::vector<study::Summary> found{};  ///< rank 0, by the stages that were done now
    /// run_job, rank 0: what a stock's night writes, or has written.
    std::optional<OutputNames> stock = std::nullopt;
};

/// All ranks call it together; a UserError is thrown on all of them.
Outcome execute(Comm& comm, Work work, const ExecuteOptions& options);

}  // namespace bemcal::run
