#include "base/random.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal {
namespace {

using Block = std::array<std::uint32_t, 4>;

// Known answers of Random123 (Salmon et al. 2011), tests/kat_vectors, philox4x32 with 10
// rounds: another version of the library may not change a result.
TEST(Philox, GivesThePublishedKnownAnswers) {
    EXPECT_EQ(philox_4x32_10({0, 0, 0, 0}, {0, 0}),
              (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    const std::uint32_t ones = 0xffffffff;
    EXPECT_EQ(philox_4x32_10({ones, ones, ones, ones}, {ones, ones}),
              (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox_4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
                             {0xa4093822, 0x299f31d0}),
              (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Stream, IsTheSameWhereverItIsMade) {
    Stream one(42, 3, 7), two(42, 3, 7);
    for (int k = 0; k < 100; ++k) EXPECT_EQ(one(), two());
}

TEST(Stream, ReadsTheBlocksOfItsKeyAndCounterInOrder) {
    Stream stream(0x1122334455667788, 9, 0xaabbccdd00112233);
    for (std::uint32_t block = 0; block < 3; ++block)
        for (const auto word :
             philox_4x32_10({block, 9, 0x00112233, 0xaabbccdd}, {0x55667788, 0x11223344}))
            EXPECT_EQ(stream(), word);
}

TEST(Stream, DiffersWithSeedStageAndItem) {
    EXPECT_NE(Stream(1, 2, 3)(), Stream(2, 2, 3)());
    EXPECT_NE(Stream(1, 2, 3)(), Stream(1, 3, 3)());
    EXPECT_NE(Stream(1, 2, 3)(), Stream(1, 2, 4)());
    EXPECT_NE(Stream(1, 2, 3)(), Stream(1, 2, 3 + (std::uint64_t{1} << 32))());
}

// Mean and variance of n = 1e6 uniforms: 5 standard errors, a false alarm in about 1e-6
// of seeds (the seed is fixed).
TEST(Stream, UniformHasTheMomentsOfTheUnitInterval) {
    Stream stream(1, 0, 0);
    const int n = 1000000;
    double sum = 0, square = 0;
    for (int k = 0; k < n; ++k) {
        const double u = stream.uniform();
        ASSERT_GT(u, 0.0);
        ASSERT_LT(u, 1.0);
        sum += u;
        square += u * u;
    }
    EXPECT_NEAR(sum / n, 0.5, 5 * std::sqrt(1.0 / 12 / n));
    EXPECT_NEAR(square / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
}

// Chi-squared with 6 degrees of freedom: above 38.3 in 1e-6 of seeds (the seed is fixed).
TEST(Stream, BelowIsUnbiased) {
    Stream stream(5, 0, 0);
    const int n = 700000;
    std::vector<int> counts(7, 0);
    for (int k = 0; k < n; ++k) ++counts.at(stream.below(7));
    double chi_squared = 0;
    for (const int count : counts)
        chi_squared += std::pow(count - n / 7.0, 2) / (n / 7.0);
    EXPECT_LT(chi_squared, 38.3);
}

// With n = 3 * 2^30 a plain remainder or product would draw some values twice as often as
// others; the share of the lowest third must still be a third (5 standard errors of 1e5
// draws).
TEST(Stream, BelowIsUnbiasedForRangesNearThePowerOfTwo) {
    Stream stream(6, 0, 0);
    const std::uint32_t n = 3U << 30;
    int lowest_third = 0;
    for (int k = 0; k < 100000; ++k) lowest_third += stream.below(n) < (1U << 30);
    EXPECT_NEAR(lowest_third / 1e5, 1.0 / 3, 5 * std::sqrt(2.0 / 9 / 1e5));
}

TEST(Stream, BelowOneIsZero) {
    EXPECT_EQ(Stream(1, 1, 1).below(1), 0U);
}

}  // namespace
}  // namespace bemcal
