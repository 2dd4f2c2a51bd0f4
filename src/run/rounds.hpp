/// The rounds of one stage: its first items, then more for as long as it asks for them.
///
/// Rank 0 has all answers so far and asks the stage; what the next round starts from goes
/// to every rank before its items do. Items are numbered through, so that a log or a
/// failure names an item of any round alike.
#pragma once

#include "run/distribute.hpp"

#include <functional>

namespace bemcal::run {

struct RoundOptions {
    DistributeOptions distribute;
    /// rank 0: what an earlier run left of items [first, first + count); may be empty
    std::function<Items(int first, int count)> known;
    std::function<void(int round)> on_round;  ///< before each: 1, 2, ...
};

/// All ranks call it together. \return the answers of all rounds on rank 0, unless
/// stopped; the seconds of all rounds together
Distributed run_rounds(Comm& comm, study::Stage& stage, const RoundOptions& options);

}  // namespace bemcal::run
