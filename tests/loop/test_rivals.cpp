#include "loop/decisions.hpp"
#include "loop/rivals.hpp"
#include "loop/windy_model.hpp"
#include "sampling/normal.hpp"

#include <string>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;
using decisions::least_probability_to_join, decisions::told_probability;

namespace {

constexpr std::size_t n_blocks = 26;

/// Falls of a mean over the blocks, and as much noise as said.
std::vector<double> falls(double mean, double noise, std::uint64_t seed) {
    Stream random(seed, 0, 0);
    std::vector<double> all(n_blocks);
    for (double& fall : all) fall = mean + noise * sampling::standard_normal(random);
    return all;
}

double probability_of(const std::string& name, const std::vector<Claim>& claims) {
    const auto all = bagged(claims, 1);
    return std::ranges::find(all, name, &Named::name)->probability;
}

}  // namespace

TEST(LoopNames, ProbabilitiesAddUpToOne) {
    const auto all = bagged({{"a", falls(0.1, 1, 1)}, {"b", falls(0.1, 1, 2)}}, 1);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].name, "");
    EXPECT_NEAR(all[0].probability + all[1].probability + all[2].probability, 1, 1e-12);
}

// exp(2 log 9 / 2) = 9 to 1 where no drawing differs from another.
TEST(LoopNames, WithoutScatterTheyAreThePosterior) {
    const std::vector<double> one(n_blocks, 1.0),
        other(n_blocks, 1 - 2 * std::log(9.0) / n_blocks);
    const std::vector<Claim> claims{{"a", one, 100}, {"b", other, 100}};
    EXPECT_NEAR(probability_of("a", claims), 0.9, 1e-9);
    EXPECT_NEAR(probability_of("b", claims), 0.1, 1e-9);
}

TEST(LoopNames, NothingIsAsProbableBefore) {
    EXPECT_NEAR(probability_of("", {{"a", std::vector<double>(n_blocks, 0.0)}}), 0.5,
                1e-9);
}

TEST(LoopNames, ClaimsOfOneNameShareWhatItHas) {
    const std::vector<double> same(n_blocks, 10.0), none(n_blocks, 0.0);
    const std::vector<Claim> claims{{"a", same}, {"a", none}, {"b", same}};
    EXPECT_NEAR(probability_of("b", claims), 2.0 / 3, 1e-9);
}

TEST(LoopNames, WhatHasNoNameIsNoneOfThese) {
    const std::vector<double> same(n_blocks, 10.0);
    EXPECT_NEAR(probability_of("", {{"a", same}, {"", same}}), 0.5, 1e-9);
}

// By all blocks "a" is ahead by about 15: a posterior has no doubt. By one block less it
// may not be: 30 of the 26 blocks' sum stem from the first.
TEST(LoopNames, OneBlockAloneLeavesADoubt) {
    std::vector<double> by_one_block(n_blocks, -0.6);
    by_one_block[0] = 30;
    const std::vector<double> none(n_blocks, 0.0);
    const double probability =
        probability_of("a", {{"a", by_one_block, 100}, {"b", none, 100}});
    EXPECT_GT(probability, 0.5);
    EXPECT_LT(probability, 0.75);
}

// Two wrong models that explain as much as each other: none is ever sure, whatever the
// noise. Of 200 pairs, a posterior would be sure (0.99) of one in most.
TEST(LoopNames, EquallyGoodOnesAreSeldomToldApart) {
    int n_sure = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const double p = probability_of("a", {{"a", falls(0, 4, 2 * seed), 500},
                                              {"b", falls(0, 4, 2 * seed + 1), 500}});
        if (p > 0.95 || p < 0.05) ++n_sure;
    }
    EXPECT_LE(n_sure, 40);
}

namespace {

/// Candidates beside a chosen one, all of which leave the residuals of the model.
struct Beside {
    explicit Beside(const std::vector<double>& gains, int number = 9) {
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
        candidate.standing.residuals = model.standing.residuals;
        return candidate;
    }
    EffectClass found() const { return class_of(model.data, model.standing, step); }

    test::WindyModel model{{}};
    Step step;
};

}  // namespace

// 2 log 9 = 4.39 of evidence.
TEST(LoopClass, ANameIsToldFromNineOfTen) {
    EXPECT_LT(Beside({95.7}).found().probability(), told_probability);
    EXPECT_GT(Beside({95.5}).found().probability(), told_probability);
    const int of_grammar = 0;
    EXPECT_LT(Beside({95.7}, of_grammar).found().probability(), told_probability);
    EXPECT_GT(Beside({95.5}, of_grammar).found().probability(), told_probability);
}

TEST(LoopClass, ANameJoinsWhereItIsMoreProbableThanNot) {
    EXPECT_GT(Beside({99.9}).found().probability(), least_probability_to_join);
    EXPECT_LT(Beside({100.1}).found().probability(), least_probability_to_join);
}

// 2 log 19 = 5.89 of evidence.
TEST(LoopClass, AnotherNameIsOfItFromOneOfTwenty) {
    EXPECT_EQ(Beside({94.2}).found().names.size(), 2U);
    EXPECT_EQ(Beside({94.0}).found().names.size(), 1U);
}

TEST(LoopClass, HasTheChosenNameFirst) {
    const EffectClass found = Beside({102}).found();
    ASSERT_EQ(found.names.size(), 2U);
    EXPECT_EQ(found.names[0].name, "chosen");
    EXPECT_LT(found.names[0].probability, found.names[1].probability);
}

TEST(LoopClass, HasFewNamesAndRivals) {
    const EffectClass two = Beside({99}).found(),
                      many = Beside(std::vector<double>(9, 99)).found();
    EXPECT_EQ(two.names.size(), 2U);
    EXPECT_EQ(many.names.size(), 3U);
    EXPECT_EQ(two.rivals.size(), 1U);
    EXPECT_EQ(many.rivals.size(), 8U);
}
