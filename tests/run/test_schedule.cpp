#include "run/schedule.hpp"

#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

std::vector<int> items(int n) {
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

/// Ranks that take turns finishing one item; the number of blocks that were handed out.
int play(Schedule& schedule, int n_ranks, std::multiset<int>& done) {
    std::vector<std::vector<int>> held(static_cast<std::size_t>(n_ranks));
    int n_blocks = 0;
    for (bool any = true; any;) {
        for (const auto& block : schedule.blocks_due()) {
            auto& mine = held[static_cast<std::size_t>(block.rank)];
            mine.insert(mine.end(), block.items.begin(), block.items.end());
            ++n_blocks;
        }
        any = false;
        for (std::size_t rank = 0; rank < held.size(); ++rank) {
            if (held[rank].empty()) continue;
            done.insert(held[rank].back());
            held[rank].pop_back();
            schedule.finished(static_cast<int>(rank));
            any = true;
        }
    }
    return n_blocks;
}

TEST(Schedule, EveryItemIsHandedOutOnce) {
    for (const int n_ranks : {1, 2, 7}) {
        Schedule schedule(items(1000), n_ranks);
        for (int rank = 0; rank < n_ranks; ++rank) schedule.join(rank, 1 + rank % 3);
        std::multiset<int> done;
        play(schedule, n_ranks, done);
        EXPECT_EQ(done.size(), 1000U);
        EXPECT_EQ(std::set<int>(done.begin(), done.end()).size(), 1000U);
        EXPECT_TRUE(schedule.is_complete());
    }
}

TEST(Schedule, BlocksAreFewWhereItemsAreMany) {
    Schedule schedule(items(100000), 4);
    for (int rank = 0; rank < 4; ++rank) schedule.join(rank, 1);
    std::multiset<int> done;
    EXPECT_LT(play(schedule, 4, done), 400);
}

TEST(Schedule, ARankHoldsMoreThanItsThreadsAreBusyWith) {
    Schedule schedule(items(100), 2);
    schedule.join(0, 1);
    schedule.join(1, 1);
    std::vector<std::size_t> held(2, 0);
    for (const auto& block : schedule.blocks_due())
        held[static_cast<std::size_t>(block.rank)] += block.items.size();
    EXPECT_GT(held[0], 1U);
    EXPECT_GT(held[1], 1U);
}

TEST(Schedule, FewItemsAreSpreadOverTheRanks) {
    Schedule schedule(items(4), 4);
    for (int rank = 0; rank < 4; ++rank) schedule.join(rank, 1);
    std::set<int> ranks;
    for (const auto& block : schedule.blocks_due()) ranks.insert(block.rank);
    EXPECT_EQ(ranks.size(), 4U);
}

TEST(Schedule, TheFirstRankToJoinDoesNotTakeTheShareOfOthers) {
    Schedule schedule(items(1600), 16);
    schedule.join(0, 1);
    std::size_t n = 0;
    for (const auto& block : schedule.blocks_due()) n += block.items.size();
    EXPECT_LE(n, 100U);
}

TEST(Schedule, IsCompleteOnlyWhenAllRanksHaveJoined) {
    Schedule schedule({}, 2);
    schedule.join(0, 1);
    EXPECT_FALSE(schedule.is_complete());
    schedule.join(1, 1);
    EXPECT_TRUE(schedule.is_complete());
}

}  // namespace
}  // namespace bemcal::run
