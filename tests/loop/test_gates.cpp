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
        candidate.consistency = 3;
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
        LastQuarter last_quarter(before.data, before.standing);
        return objection_to(before.data, before.standing, candidate, 20, last_quarter);
    }
    test::WindyModel before, after;
    Refitted candidate;
};

constexpr const char *passes = "", *too_little = "left-out error falls too little",
                     *rises = "left-out error of a meter rises",
                     *too_few = "too few unseen fortnights gain";

}  // namespace

TEST(LoopGates, WhatIsThereAndSeenEverywherePassesAll) {
    EXPECT_EQ(Judged().objection(), "");
}

TEST(LoopGates, NoiseShowsAsMuchEvidence) {
    Judged judged;
    judged.candidate.gain = 19;
    EXPECT_EQ(judged.objection(), "evidence below what noise shows");
}

TEST(LoopGates, AMeanOverTheMetersHasToFallAndNoMeterMayRise) {
    Judged judged;
    judged.candidate.error.assign(judged.candidate.error.size(), -0.001);
    EXPECT_EQ(judged.objection(), "left-out error falls too little");
    auto& noise = judged.before.standing.noise;
    noise.push_back(noise[0]);  // another meter
    judged.candidate.error = {-0.2, 0.05};
    EXPECT_EQ(judged.objection(), "left-out error of a meter rises");
}

// The other meters see nothing of a factor on one, and would divide its fall by their
// number.
TEST(LoopGates, WhatEntersAtAMeterIsJudgedThere) {
    Judged judged;
    auto& noise = judged.before.standing.noise;
    noise.resize(5, noise[0]);
    judged.candidate.error = {-0.07, 0, 0, 0, 0};
    judged.candidate.gain = 61;
    EXPECT_EQ(judged.objection(), "left-out error falls too little");
    judged.candidate.effect.hook = effects::Hook::meter_factor;
    EXPECT_EQ(judged.objection(), "");
    judged.candidate.gain = 59;
    EXPECT_EQ(judged.objection(), "left-out error falls too little");
}

// Few fortnights need gain where evidence is far above what noise shows, or where those
// that no fit has seen gain more than the evidence.
TEST(LoopGates, FewUnseenFortnightsAreNotEnoughUnlessTheySayMore) {
    Judged judged;
    judged.candidate.consistency = 1;
    EXPECT_EQ(judged.objection(), "too few unseen fortnights gain");
    judged.candidate.score = 51;
    EXPECT_EQ(judged.objection(), "");
    judged.candidate.score = 40;
    judged.candidate.gain = 61;
    EXPECT_EQ(judged.objection(), "");
}

// What takes the wind out of the model again foretells nothing: but a season may be
// wrong.
TEST(LoopGates, TheLastQuarterIsForetoldNoWorseUnlessMuchElseSpeaksForTheEffect) {
    Judged judged;
    judged.candidate.standing = judged.before.standing;
    const auto objection = [&] {
        LastQuarter last_quarter(judged.after.data, judged.after.standing);
        return objection_to(judged.after.data, judged.after.standing, judged.candidate,
                            20, last_quarter);
    };
    EXPECT_EQ(objection(), "last quarter is foretold worse");
    judged.candidate.score = 51;
    EXPECT_EQ(objection(), "");
    judged.candidate.consistency = 1;
    EXPECT_EQ(objection(), "last quarter is foretold worse");
    judged.candidate.gain = 61;
    EXPECT_EQ(objection(), "");
}

TEST(LoopGates, ADriftOfTheGrammarIsNotCarriedOn) {
    Judged judged;
    judged.candidate.effect.number = 0;
    judged.candidate.effect.driver = effects::Driver::elapsed;
    judged.candidate.effect.shape.form = effects::Form::linear;
    EXPECT_EQ(judged.objection(), "a drift without a name: it may not go on");
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
    judged.candidate.effect.number = 0;  // of the grammar
    EXPECT_EQ(judged.objection({-0.0599}), too_little);
    EXPECT_EQ(judged.objection({-0.0601}), passes);
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
    judged.candidate.gain = 159;  // less than eight thresholds
    EXPECT_EQ(judged.objection({-0.2, 0.0301}), rises);
    judged.candidate.gain = 161;
    EXPECT_EQ(judged.objection({-0.2, 0.0599}), passes);
    EXPECT_EQ(judged.objection({-0.2, 0.0601}), rises);
}

TEST(LoopGates, AMeterCountsFromHalfItsWeightOn) {
    Judged judged;
    EXPECT_EQ(judged.objection({-0.06, 0.0101}, 0.51), rises);
    EXPECT_EQ(judged.objection({-0.06, 0.0101}, 0.49), passes);
}

TEST(LoopGates, ASmallMeterIsMendedByFifteenPercent) {
    Judged judged;
    EXPECT_EQ(judged.objection({0, -0.149}, 0.2), too_little);
    EXPECT_EQ(judged.objection({0, -0.151}, 0.2), passes);
}

TEST(LoopGates, AnEffectAtAMeterMendsItByFivePercent) {
    Judged judged;
    judged.candidate.effect.hook = effects::Hook::meter_factor;
    judged.candidate.gain = 61;
    EXPECT_EQ(judged.objection({-0.049, 0, 0, 0, 0}), too_little);
    EXPECT_EQ(judged.objection({-0.051, 0, 0, 0, 0}), passes);
}

TEST(LoopGates, WhatIsCertainMayBringLess) {
    Judged judged;
    judged.candidate.gain = 149;
    EXPECT_EQ(judged.objection({-0.0141}), too_little);
    judged.candidate.gain = 151;
    EXPECT_EQ(judged.objection({-0.0141}), passes);
    EXPECT_EQ(judged.objection({-0.0139}), too_little);
}

TEST(LoopGates, TwoStandardErrorsAreOften) {
    Judged judged;
    judged.candidate.consistency = 1.99;
    EXPECT_EQ(judged.objection(), too_few);
    judged.candidate.consistency = 2;
    EXPECT_EQ(judged.objection(), passes);
}

TEST(LoopGates, WhatIsForetoldByTwoThresholdsNeedNotBeSeenOften) {
    Judged judged;
    judged.candidate.consistency = 1;
    judged.candidate.gain = 30;
    judged.candidate.score = 39;
    EXPECT_EQ(judged.objection(), too_few);
    judged.candidate.score = 41;
    EXPECT_EQ(judged.objection(), passes);
}
