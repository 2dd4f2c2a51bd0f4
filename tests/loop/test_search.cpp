#include "loop/search.hpp"
#include "sampling/normal.hpp"

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;

namespace {

constexpr std::size_t n_candidates = 40, n_blocks = 26;

/// Candidates that there is nothing behind: their blocks' scores are noise.
std::vector<Screened> noise_only(std::uint64_t seed) {
    Stream random(seed, 0, 0);
    std::vector<Screened> screened(n_candidates);
    for (Screened& candidate : screened) {
        candidate.information = n_blocks;
        for (std::size_t b = 0; b < n_blocks; ++b)
            candidate.by_block.push_back(sampling::standard_normal(random));
    }
    return screened;
}

double largest_gain(const std::vector<Screened>& screened) {
    double largest = 0;
    for (const Screened& candidate : screened) {
        double sum = 0;
        for (const double score : candidate.by_block) sum += score;
        largest = std::max(largest, sum * sum / candidate.information);
    }
    return largest;
}

}  // namespace

// 300 searches at a level of 5 %: 15 are expected to pass; fewer than 4 or more than 30
// would be seen in one of 10,000 runs of a test that is as it should be.
TEST(LoopSearch, NoiseAlonePassesTheThresholdAsOftenAsItMay) {
    int n_passed = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const auto screened = noise_only(seed);
        if (largest_gain(screened) > null_gain(screened, 0.05, seed)) ++n_passed;
    }
    EXPECT_GE(n_passed, 4);
    EXPECT_LE(n_passed, 30);
}

TEST(LoopSearch, ASignalInEveryBlockPasses) {
    auto screened = noise_only(7);
    for (double& score : screened[3].by_block) score += 3;
    EXPECT_GT(largest_gain(screened), null_gain(screened, 0.01, 7));
}

TEST(LoopSearch, TheThresholdIsTheSameForTheSameSeed) {
    const auto screened = noise_only(1);
    EXPECT_EQ(null_gain(screened, 0.01, 5), null_gain(screened, 0.01, 5));
}

// Two blocks have four patterns of signs, of which the largest sum is seldom missed: 13.4
// is what 99 of 100 sets of 40 normal candidates stay below (Bonferroni).
TEST(LoopSearch, AFewBlocksDoNotLowerTheThreshold) {
    auto screened = noise_only(2);
    for (Screened& candidate : screened) candidate.by_block.resize(2);
    EXPECT_NEAR(null_gain(screened, 0.01, 3), 13.4, 0.1);
}
