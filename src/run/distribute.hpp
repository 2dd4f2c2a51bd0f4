/// Items over ranks and threads. Rank 0 hands out blocks, the next one sent ahead, and
/// computes too; on every rank the main thread only talks, sleeping between polls, and
/// compute threads run the items. A signal or an error on any rank stops all of them.
///
/// Who computes an item shows nowhere: answers are returned in item order.
#pragma once

#include "run/comm.hpp"
#include "run/stopping.hpp"
#include "study/stage.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace bemcal::run {

struct Progress {
    int items_done = 0, items_known = 0, items_total = 0;  ///< done includes known
    long long points_failed = 0;
    double seconds = 0;          ///< since these items began
    study::Activity activity{};  ///< of all ranks
};

/// Callbacks are called by main threads, never at the same time on a rank; each may be
/// empty.
struct DistributeOptions {
    int n_threads = 1;
    double item_seconds = 0;  ///< an item that takes longer is unfinished; 0 = no limit
    /// What the stage refers to, itself included: a thread left behind may outlive it.
    std::shared_ptr<const void> keep;
    /// On the rank that computed the item, before the item counts. A UserError ends all
    /// ranks.
    std::function<void(int item, const Bytes& packed)> on_finished;
    std::function<void()> on_tick;                     ///< every rank, between polls
    std::function<void(const Progress&)> on_progress;  ///< rank 0, a few times a second
    std::function<void()> on_stopping;  ///< rank 0, once, when a stop is asked for
    /// Every rank, once a stop is asked for, and after the items that finish then: what
    /// is finished has to be on the disk on return.
    std::function<void()> on_hurry;
    std::function<Stopping()> should_stop;  ///< polled on every rank
};

/// Items [first, first + count) of a stage, and on rank 0 what is known of their answers.
struct Items {
    int first = 0, count = 0;
    std::vector<study::ItemAnswer> known;  ///< [count] from an earlier run; empty = none
    std::vector<bool> has;  ///< [count]: where false, the item is done again; empty = all
};

struct Distributed {
    /// Rank 0: in item order, complete unless stopped.
    std::vector<study::ItemAnswer> answers;
    bool stopped = false;     ///< the same on every rank
    double seconds = 0;       ///< of this rank
    double busy_seconds = 0;  ///< of this rank's compute threads, in items
};

/// All ranks call it together; a UserError from a callback of any rank is thrown on all
/// of them.
Distributed distribute(Comm& comm, const study::Stage& stage, Items items,
                       const DistributeOptions& options);

}  // namespace bemcal::run
