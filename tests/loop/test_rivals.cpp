#include "loop/rivals.hpp"
#include "sampling/normal.hpp"

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;

namespace {

constexpr std::size_t n_blocks = 26;

std::vector<double> noisy(double mean, std::uint64_t seed) {
    Stream random(seed, 0, 0);
    std::vector<double> losses(n_blocks);
    for (double& loss : losses) loss = mean + sampling::standard_normal(random);
    return losses;
}

}  // namespace

// One of twenty pairs that are equal is told apart: of 400, 20 are expected; more than 45
// would be seen in fewer than one of 10,000 runs of a test that is as it should be.
TEST(LoopClass, EquallyGoodOnesAreSeldomToldApart) {
    int n_told = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed)
        if (!is_as_good(noisy(100, 2 * seed), noisy(100, 2 * seed + 1))) ++n_told;
    EXPECT_LE(n_told, 45);
    EXPECT_GE(n_told, 5);
}

TEST(LoopClass, OneThatLosesMoreInMostBlocksIsToldApart) {
    EXPECT_FALSE(is_as_good(noisy(102, 1), noisy(100, 2)));
}

TEST(LoopClass, ABetterOneIsAsGood) {
    EXPECT_TRUE(is_as_good(noisy(98, 1), noisy(100, 2)));
}

TEST(LoopClass, ADifferenceOfNothingIsNoneHoweverRegular) {
    const std::vector<double> losses(n_blocks, 100.1), chosen(n_blocks, 100);
    EXPECT_TRUE(is_as_good(losses, chosen));
    EXPECT_FALSE(is_as_good(std::vector<double>(n_blocks, 101), chosen));
}
