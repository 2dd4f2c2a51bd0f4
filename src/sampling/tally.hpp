/// How far the chains of a call are, for whoever looks while they run.
#pragma once

#include <atomic>

namespace bemcal::sampling {

/// Of the coldest walkers of all chains.
struct Tally {
    std::atomic<long long> transitions = 0, steps = 0;
    std::atomic<double> acceptance = 0;  ///< sum over transitions

    void add(double its_acceptance, int n_steps) {
        constexpr auto unordered = std::memory_order_relaxed;
        acceptance.fetch_add(its_acceptance, unordered);
        steps.fetch_add(n_steps, unordered);
        transitions.fetch_add(1, unordered);
    }
};

}  // namespace bemcal::sampling
