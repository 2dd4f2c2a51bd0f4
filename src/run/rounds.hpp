/// The rounds of one stage: its first items, then more for as long as it asks for them.
///
/// Rank 0 has all answers so far and asks the stage; what the next round starts from goes
/// to every rank before its items do. Items are numbered through, so that a log or a
/// failure names an item of any round alike.
#pragma once

#include "run/distribute.hpp"

#include <cstdint>
#include <functional>

namespace bemcal::run {

/// Which round, and the checksum of what it starts from (0 in the first): the items of a
/// round that starts from something else are others, whatever their numbers.
struct RoundStart {
    int round = 1;
    std::uint64_t checksum = 0;
};

struct RoundOptions {
    DistributeOptions distribute;
    /// rank 0: what an earlier run left of items [first, first + count); may be empty
    std::function<Items(int first, int count)> known;
    /// every rank, before each round and its `known`
    std::function<void(const RoundStart& start)> on_round;
};

/// All ranks call it together. \return the answers of all rounds on rank 0, unless
/// stopped; the seconds of all rounds together
Distributed run_rounds(Comm& comm, study::Stage& stage, const RoundOptions& options);

}  // namespace bemcal::run
