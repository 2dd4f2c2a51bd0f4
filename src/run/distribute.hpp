/// Items over ranks and threads. Rank 0 hands out blocks, the next one sent ahead, and computes
/// too; on every rank the main thread only talks, sleeping between polls, and compute threads run
/// the items. A signal on any rank stops all of them.
#pragma once

#include <functional>
#include <vector>

#include "run/comm.hpp"
#include "study/stage.hpp"

namespace bemcal::run {

struct Progress {
    int items_done = 0, items_total = 0;
    long long points_failed = 0;
    double seconds = 0;              ///< since the stage began
};

struct DistributeOptions {
    int n_threads = 1;
    /// Called on the rank that computed the item, by its main thread, before the item counts.
    std::function<void(int item, const study::ItemAnswer&)> on_finished;
    std::function<void(const Progress&)> on_progress;   ///< rank 0, a few times a second
    std::function<bool()> should_stop;                  ///< polled on every rank
};

struct Distributed {
    std::vector<study::ItemAnswer> answers;  ///< rank 0: in item order, complete unless stopped
    bool stopped = false;                    ///< the same on every rank
};

/// \param known  rank 0: answers from an earlier run, by item; empty vector = none. An item is
///               done again where `has[item]` is false.
Distributed distribute(Comm& comm, const study::Stage& stage, std::vector<study::ItemAnswer> known,
                       const std::vector<bool>& has, const DistributeOptions& options);

}  // namespace bemcal::run
