#include "effects/steps.hpp"
#include "loop/gates.hpp"
#include "loop/windy_model.hpp"

#include <string>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;
using test::named;

namespace {

/// The building without and with the wind that is in its readings, and what a judge would
/// have found of it.
struct Judged {
    Judged() : before({}), after({"wind infiltration"}) {
        candidate.effect = after.standing.model.effects[0];
        candidate.standing = after.standing;
        candidate.coefficient = after.standing.coefficient(0);
        candidate.gain = 50;
        candidate.score = 40;
        candidate.error.assign(before.standing.noise.size(), -0.2);
    }
    /// With meters that count, or little, whose unseen errors change so.
    std::string objection(const std::vector<double>& error, double share_of_second = 1) {
        candidate.error = error;
        auto& noise = before.standing.noise;
        noise.resize(error.size(), noise[0]);
        if (noise.size() > 1) noise[1].share = share_of_second;
        return objection();
    }
    std::string objection() {
        LastReadings last_readings(before.data, before.standing);
        return objection_to(before.data, before.standing, candidate, 20, last_readings);
    }
    test::WindyModel before, after;
    Refitted candidate;
};

constexpr const char *passes = "", *too_little = "left-out error falls too little",
                     *rises = "left-out error of a meter rises",
                     *foretells_too_little = "unseen blocks show too little of it",
                     *foretells_nothing =
                         "follows time, but does not foretell what comes";

}  // namespace

TEST(LoopGates, WhatIsThereAndSeenEverywherePassesAll) {
    EXPECT_EQ(Judged().objection(), "");
}

TEST(LoopGates, NoiseShowsAsMuchEvidence) {
    Judged judged;
    judged.candidate.gain = 19;
    EXPECT_EQ(judged.objection(), "evidence below what noise shows");
}

TEST(LoopGates, UnseenBlocksShowMostOfTheEvidence) {
    Judged judged;  // its evidence is 50
    judged.candidate.score = 35.9;
    EXPECT_EQ(judged.objection(), foretells_too_little);
    judged.candidate.score = 36.1;
    EXPECT_EQ(judged.objection(), passes);
}

// What takes the wind out of the model again foretells nothing: but a season may be
// wrong, and only what follows time goes on.
TEST(LoopGates, WhatComesIsForetoldNoWorseByWhatFollowsTime) {
    Judged judged;
    judged.candidate.standing = judged.before.standing;
    const auto objection = [&] {
        LastReadings last_readings(judged.after.data, judged.after.standing);
        return objection_to(judged.after.data, judged.after.standing, judged.candidate,
                            20, last_readings);
    };
    EXPECT_EQ(objection(), passes);
    judged.candidate.effect.driver = effects::Driver::elapsed;
    EXPECT_EQ(objection(), foretells_nothing);
}

// Of a step in the last quarter nothing before it knows the size: half of what follows it
// is foretold by the other half.
TEST(LoopGates, AStepIsLearnedFromWhatFollowsIt) {
    effects::Effect colder;
    colder.name = "colder";
    colder.hook = effects::Hook::heating_set_point;
    colder.driver = effects::Driver::elapsed;
    colder.least = -4;
    colder.most = 4;
    study::Case made = test::windy_case();
    const double years = (7 + 0.85 * (test::n_training - 7) - 7) / 365.25;
    colder.shape = {effects::Form::over, years};
    test::measure(made, colder, -2, 3);
    const LoopData data(made, test::WindyModel::options());
    const Place place = make_place(data, {}, data.drive);
    const std::vector<double> start(place.unknowns.size());
    const Standing before = calibrate(data, place, {}, start);
    LoopModel with;
    with.effects.push_back(colder);
    std::vector<double> more = start;
    more.push_back(-2);
    const Standing after = calibrate(data, place, with, more);
    LastReadings last_readings(data, before);
    EXPECT_LT(last_readings.change_to(after, colder), -0.1);
}

// Half of what follows a step in the middle is the last quarter, which stays the least.
TEST(LoopGates, HalfOfWhatFollowsAStepIsForetold) {
    const Judged judged;
    const LoopData& data = judged.after.data;
    const LastReadings last_readings(data, judged.after.standing);
    const auto last = *std::ranges::max_element(data.begins);
    const auto span = last - data.training().from;
    const auto begin_behind = [&](double share) {
        effects::Effect step;
        step.driver = effects::Driver::elapsed;
        step.shape = {effects::Form::over, share * static_cast<double>(span.count()) /
                                               effects::elapsed_year_s};
        return last_readings.begin_for(step);
    };
    EXPECT_EQ(begin_behind(0.48), begin_behind(0.1));
    EXPECT_GT(begin_behind(0.52), begin_behind(0.1));
    EXPECT_NEAR(static_cast<double>((last - begin_behind(0.8)).count()),
                0.1 * static_cast<double>(span.count()), 2);
}

TEST(LoopGates, ACoefficientIsPlausibleByHalfBeyondEachEnd) {
    effects::Effect shade;
    shade.least = -0.9;
    shade.most = 0.3;
    EXPECT_TRUE(is_plausible(shade, 0.44));
    EXPECT_FALSE(is_plausible(shade, 0.46));
    EXPECT_TRUE(is_plausible(shade, -1.3));
    effects::Effect fan;
    fan.least = 0.3;
    fan.most = 1;
    EXPECT_FALSE(is_plausible(fan, 0.19));
    EXPECT_TRUE(is_plausible(fan, 0.21));
    EXPECT_FALSE(is_plausible(fan, 1.51));
    effects::Effect fouling;
    fouling.least = -0.6;
    fouling.most = -0.3;
    EXPECT_TRUE(is_plausible(fouling, -0.89));
    EXPECT_FALSE(is_plausible(fouling, -0.19));
}

// Here and below: just below a number that decides, and just above it.
TEST(LoopGates, TheMeanErrorFallsByTheLeastGain) {
    Judged judged;
    EXPECT_EQ(judged.objection({-0.0199}), too_little);
    EXPECT_EQ(judged.objection({-0.0201}), passes);
    EXPECT_EQ(judged.objection({-0.0399, 0}), too_little);
    EXPECT_EQ(judged.objection({-0.0401, 0}), passes);
    EXPECT_EQ(judged.objection({-0.0201, 0}, 0.2), passes) << "one of them counts";
}

TEST(LoopGates, AMeterMayRiseByTheMostLoss) {
    Judged judged;
    EXPECT_EQ(judged.objection({-0.06, 0.0099}), passes);
    EXPECT_EQ(judged.objection({-0.06, 0.0101}), rises);
}

TEST(LoopGates, AMeterMayLoseInExchange) {
    Judged judged;
    EXPECT_EQ(judged.objection({-0.2, 0.0299}), passes);  // 15 % of 20 %
    EXPECT_EQ(judged.objection({-0.2, 0.0301}), rises);
}

TEST(LoopGates, AMeterCountsFromHalfItsWeightOn) {
    Judged judged;
    EXPECT_EQ(judged.objection({-0.06, 0.0101}, 0.51), rises);
    EXPECT_EQ(judged.objection({-0.06, 0.0101}, 0.49), passes);
}
