#include "loop/rivals.hpp"
#include "loop/windy_model.hpp"
#include "sampling/normal.hpp"

#include <string>

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

TEST(LoopClass, ADifferenceOfLessThanSixIsNone) {
    const std::vector<double> chosen(n_blocks, 100);
    EXPECT_TRUE(is_as_good(std::vector<double>(n_blocks, 100 + 5.9 / n_blocks), chosen));
    EXPECT_FALSE(is_as_good(std::vector<double>(n_blocks, 100 + 6.1 / n_blocks), chosen));
}

namespace {

/// Candidates beside a chosen one of evidence 100 that leave what it leaves.
struct Beside {
    explicit Beside(std::vector<double> gains, int number = 9) {
        step.ranking.push_back(one("chosen", 100, 9));
        for (const double gain : gains)
            step.ranking.push_back(
                one("rival " + std::to_string(step.ranking.size()), gain, number));
        step.chosen = 0;
    }
    Refitted one(const std::string& name, double gain, int number) const {
        Refitted candidate;
        candidate.effect.name = name;
        candidate.effect.number = number;
        candidate.gain = gain;
        candidate.left_out = model.standing.left_out;
        return candidate;
    }
    EffectClass found() const { return class_of(model.data, model.standing, step); }

    test::WindyModel model{{}};
    Step step;
};

}  // namespace

TEST(LoopClass, ARivalHasMostOfTheEvidence) {
    EXPECT_TRUE(Beside({69.9}).found().is_told);
    EXPECT_FALSE(Beside({70.1}).found().is_told);
    const int of_grammar = 0;
    EXPECT_TRUE(Beside({109.9}, of_grammar).found().is_told);
    EXPECT_FALSE(Beside({110.1}, of_grammar).found().is_told);
}

TEST(LoopClass, HasFewNamesAndRivals) {
    const EffectClass two = Beside({90}).found(),
                      many = Beside(std::vector<double>(9, 90)).found();
    EXPECT_EQ(two.names.size(), 2U);
    EXPECT_EQ(many.names.size(), 3U);
    EXPECT_EQ(two.rivals.size(), 1U);
    EXPECT_EQ(many.rivals.size(), 8U);
}
