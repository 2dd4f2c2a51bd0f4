/// Who computes what: blocks of a quarter of a fair share of what remains, given to the
/// rank with the least work for each thread, the next one ahead.
/// Source: guided self-scheduling, Polychronopoulos and Kuck 1987. Items count as equally
/// long; what is handed out is not taken back.
#include "run/schedule.hpp"

#include <algorithm>
#include <utility>

namespace bemcal::run {

Schedule::Schedule(std::vector<int> items, int n_ranks)
    : items_(std::move(items)), ranks_(static_cast<std::size_t>(n_ranks)) {}

void Schedule::join(int rank, int n_threads) {
    ranks_[static_cast<std::size_t>(rank)].n_threads = n_threads;
}

void Schedule::finished(int rank) {
    --ranks_[static_cast<std::size_t>(rank)].n_outstanding;
    ++n_finished_;
}

bool Schedule::is_complete() const {
    return n_finished_ == items_.size() &&
           std::ranges::all_of(ranks_,
                               [](const Rank& rank) { return rank.n_threads > 0; });
}

/// Ranks that have not joined yet count with the threads of the widest that has.
int Schedule::block_size() const {
    const int widest = std::ranges::max(ranks_, {}, &Rank::n_threads).n_threads;
    int n_threads = 0;
    for (const Rank& rank : ranks_)
        n_threads += rank.n_threads > 0 ? rank.n_threads : widest;
    const auto share =
        n_remaining() / (4 * static_cast<std::size_t>(std::max(1, n_threads)));
    return static_cast<int>(std::clamp<std::size_t>(share, 1, 512));
}

/// The joined rank with the least work for each thread, if any may have more.
Schedule::Rank* Schedule::neediest() {
    const int block = block_size();
    Rank* found = nullptr;
    for (Rank& rank : ranks_) {
        // Single items are long: none waits at a rank while another has nothing.
        const int ahead = block > 1 ? block : 0;
        if (rank.n_threads == 0 || rank.n_outstanding >= rank.n_threads + ahead) continue;
        if (!found ||
            rank.n_outstanding * found->n_threads < found->n_outstanding * rank.n_threads)
            found = &rank;
    }
    return found;
}

std::vector<Schedule::Block> Schedule::blocks_due() {
    std::vector<Block> blocks;
    while (n_remaining() > 0) {
        Rank* rank = neediest();
        if (!rank) break;
        const auto n = std::min(n_remaining(), static_cast<std::size_t>(block_size()));
        const auto first = items_.begin() + static_cast<std::ptrdiff_t>(next_);
        blocks.push_back({static_cast<int>(rank - ranks_.data()),
                          {first, first + static_cast<std::ptrdiff_t>(n)}});
        next_ += n;
        rank->n_outstanding += static_cast<int>(n);
    }
    return blocks;
}

}  // namespace bemcal::run
