#include "loop/consistency.hpp"
#include "sampling/normal.hpp"

#include <gtest/gtest.h>

using namespace bemcal;
using loop::BlockChange, loop::consistency_of;

namespace {

std::vector<loop::BlockChange> noise(std::size_t n, std::uint64_t seed) {
    Stream random(seed, 0, 0);
    std::vector<loop::BlockChange> changes;
    for (std::size_t b = 0; b < n; ++b)
        changes.push_back({sampling::standard_normal(random), 1});
    return changes;
}

}  // namespace

// The larger of two statistics that hang together, each over 2 in one of 44: of 1,000, 25
// to 45 are expected; more than 65 or fewer than 12 would be seen in fewer than one of
// 1,000 runs of a test that is as it should be.
TEST(LoopConsistency, EquallyGoodModelsSeldomLookDifferent) {
    int n_over = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed)
        if (consistency_of(noise(26, seed)) > 2) ++n_over;
    EXPECT_GE(n_over, 12);
    EXPECT_LE(n_over, 65);
}

TEST(LoopConsistency, OneBlockInWhichMuchFallsDoesNotHideThatOthersAgree) {
    std::vector<BlockChange> changes(12, {1, 1});
    changes[3].fall = 500;
    EXPECT_GT(consistency_of(changes), 2.5);
}

TEST(LoopConsistency, AnEffectOfASeasonIsJudgedInIt) {
    std::vector<BlockChange> changes = noise(26, 5);
    for (std::size_t b = 0; b < changes.size(); ++b)
        changes[b] = b < 6 ? BlockChange{3 + 0.1 * changes[b].fall, 10}
                           : BlockChange{2 * changes[b].fall - 0.6, 0.01};
    EXPECT_GT(consistency_of(changes), 2);
    for (BlockChange& change : changes) change.moved = 1;
    EXPECT_LT(consistency_of(changes), 2);
}

TEST(LoopConsistency, HarmInMostBlocksIsNoGain) {
    std::vector<BlockChange> changes(20, {-1, 1});
    changes[0].fall = 10;
    EXPECT_LT(consistency_of(changes), 0);
}

TEST(LoopConsistency, NothingIsNothing) {
    EXPECT_EQ(consistency_of({}), 0);
    EXPECT_EQ(consistency_of(std::vector<BlockChange>(5)), 0);
}

// Harm in blocks that hardly move counts from a twentieth of the most moved on.
TEST(LoopConsistency, BlocksCountFromATwentiethOfTheMostMoved) {
    std::vector<BlockChange> changes(6, {1, 10});
    changes.resize(30, {-1, 0.49});
    EXPECT_GT(consistency_of(changes), 2);
    for (std::size_t b = 6; b < changes.size(); ++b) changes[b].moved = 0.51;
    EXPECT_LT(consistency_of(changes), 0);
}

TEST(LoopConsistency, FewerThanFourMovedBlocksAreTooFew) {
    std::vector<BlockChange> changes(4, {1, 10});
    changes.resize(30, {-1, 0});
    EXPECT_GT(consistency_of(changes), 0);
    changes[3] = {-1, 0};
    EXPECT_LT(consistency_of(changes), 0);
}
