/// Effects that a misfit hides, and functions show.
#include "loop/effect_search.hpp"
#include "loop/loop.hpp"
#include "loop/windy_case.hpp"
#include "study/find.hpp"

#include <algorithm>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;

namespace {

std::vector<Dataset> searched(double gains, double wind, bool functions,
                              const std::string& name = "wind infiltration") {
    Case made = test::windy_case();
    test::measure(made, {test::gains_of_the_morning(), test::named("wind infiltration")},
                  {gains, wind}, 3);
    LoopOptions options;
    options.block_days = 7;
    options.try_structures = false;
    options.functions = functions;
    options.generic = false;
    for (const effects::Entry& entry : effects::catalogue())
        if (entry.effect.name != name) options.exclude.push_back(entry.effect.name);
    const std::vector<Case> buildings = {made};
    const auto stage = make_loop("loop", buildings, options);
    return stage->conclude({stage->run(0)}).datasets;
}

}  // namespace

TEST(BesideFunctions, WhatAMisfitHidesIsSeenBesideThem) {
    EXPECT_TRUE(test::find(searched(40, 0.02, false), "effect").texts.empty());
    const auto datasets = searched(40, 0.02, true);
    EXPECT_EQ(test::find(datasets, "effect").texts,
              std::vector<std::string>{"wind infiltration"});
    EXPECT_GT(std::ranges::max(test::find(datasets, "step_gain").values), 50);
    // What the functions are is not lost.
    EXPECT_FALSE(test::find(datasets, "function").texts.empty());
}

TEST(BesideFunctions, WhereThereIsNoneNoneIsFound) {
    for (const double gains : {10.0, 20.0, 40.0})
        EXPECT_TRUE(test::find(searched(gains, 0, true), "effect").texts.empty());
}

// A fan that never stops is not the wind.
TEST(BesideFunctions, WhatFunctionsForetellAsWellLeavesAgain) {
    const auto datasets = searched(40, 0.03, true, "exhaust fan");
    EXPECT_TRUE(test::find(datasets, "effect").texts.empty());
    const auto& verdicts = test::find(datasets, "step_verdict").texts;
    ASSERT_GE(verdicts.size(), 2U);
    EXPECT_EQ(verdicts[verdicts.size() - 2], "accepted");
    EXPECT_EQ(verdicts.back(), "taken out: functions foretell as much without it");
}

// Gains of the morning are no early start; the fan is as near to them as functions are.
TEST(BesideFunctions, AnEffectWithoutWhichFunctionsForetellMoreLeaves) {
    const auto found = [](double gains, const char* name, bool functions) {
        const auto datasets = searched(gains, 0, functions, name);
        const auto& verdicts = test::find(datasets, "step_verdict").texts;
        return std::pair(test::find(datasets, "effect").texts, verdicts.back());
    };
    const std::vector<std::string> none, early{"early start"}, fan{"exhaust fan"};
    EXPECT_EQ(found(-20, "early start", false).first, early);
    EXPECT_EQ(
        found(-40, "early start", true),
        std::pair(none, std::string("taken out: functions foretell more without it")));
    EXPECT_EQ(found(-24, "early start", true).first, early) << "a name is worth some";
    EXPECT_EQ(found(-20, "exhaust fan", true).first, fan);
}

TEST(BesideFunctions, ThreeThresholdsOfEvidenceTell) {
    Found found;
    found.needed = 20;
    found.gain = 59.9;
    EXPECT_FALSE(tells_beside_functions(found));
    found.gain = 60;
    EXPECT_TRUE(tells_beside_functions(found));
}
