#include "loop/search.hpp"
#include "sampling/normal.hpp"

#include <cmath>
#include <string>

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

namespace {

constexpr int of_grammar = 0, of_catalogue = 9;

Screened screened_with(const std::string& name, int number, double gain) {
    Screened screened;
    screened.effect.name = name;
    screened.effect.number = number;
    screened.effect.typical = 1;
    screened.gain = gain;
    return screened;
}

Refitted refitted_with(int number, double gain, const std::string& objection = "") {
    Refitted candidate;
    candidate.effect.number = number;
    candidate.gain = gain;
    candidate.objection = objection;
    return candidate;
}

}  // namespace

TEST(LoopSearch, AsManyAreRefittedAsAreListed) {
    std::vector<Screened> all;
    for (int k = 1; k <= 40; ++k) all.push_back(screened_with("one", k, 100));
    EXPECT_EQ(shortlist(all).size(), 36U);
    all.assign(40, screened_with("one", of_catalogue, 100));
    EXPECT_EQ(shortlist(all).size(), 3U);
    all.assign(40, screened_with("one", of_grammar, 100));
    EXPECT_EQ(shortlist(all).size(), 3U);
    for (Screened& one : all) one.gain = 0;
    EXPECT_TRUE(shortlist(all).empty());
}

TEST(LoopSearch, FreedomCostsPicksAMissingNameAndABlamedMeter) {
    Screened one = screened_with("one", of_catalogue, 100);
    EXPECT_EQ(occam(one), 0);
    one.effect.number = of_grammar;
    EXPECT_DOUBLE_EQ(occam(one), 4.6);
    one.effect.number = of_catalogue;
    one.effect.hook = effects::Hook::meter_factor;
    EXPECT_DOUBLE_EQ(occam(one), 4.6);
    one.effect.hook = effects::Hook::heating_efficiency;
    one.effect.days = {{10, 10}, {20, 22}, {30, 30, false, true}, {40, 40, false, true}};
    EXPECT_DOUBLE_EQ(occam(one), 2 * 2 * std::log(365.0));
    one.effect.calendar = "US";  // one pick for all of its days
    EXPECT_DOUBLE_EQ(occam(one), 3 * 2 * std::log(365.0));
}

TEST(LoopSearch, DatesMoveOfWhatMayLead) {
    Refitted season = refitted_with(of_catalogue, 101);
    season.effect.driver = effects::Driver::day_of_year;
    EXPECT_TRUE(may_lead_by_dates(season, 200));
    season.gain = 99;
    EXPECT_FALSE(may_lead_by_dates(season, 200));
    season.gain = 301;
    EXPECT_TRUE(may_lead_by_dates(season, 1000));
    season.gain = 299;
    EXPECT_FALSE(may_lead_by_dates(season, 1000));
    season.gain = 301;
    season.effect.number = of_grammar;
    EXPECT_FALSE(may_lead_by_dates(season, 1000));
}

TEST(LoopSearch, TheFirstNameThatPassesIsTaken) {
    std::vector<Refitted> ranking = {
        refitted_with(of_grammar, 100), refitted_with(of_catalogue, 90, "fails"),
        refitted_with(of_catalogue, 61), refitted_with(of_catalogue, 60)};
    EXPECT_EQ(choice_of(ranking), 2);
    ranking.resize(2);
    EXPECT_EQ(choice_of(ranking), -1);
}

TEST(LoopSearch, WhatHasNoNameIsNotTakenUnlessItFollowsASeriesOfTheJob) {
    std::vector<Refitted> ranking = {refitted_with(of_grammar, 100)};
    EXPECT_EQ(choice_of(ranking), -1);
    EXPECT_EQ(ranking[0].objection, "has no name: left to functions");
    ranking = {refitted_with(of_grammar, 100)};
    ranking[0].effect.driver = effects::Driver::column;
    EXPECT_EQ(choice_of(ranking), 0);
}
