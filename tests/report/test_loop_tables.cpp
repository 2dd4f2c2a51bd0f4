#include "report/tables.hpp"
#include "store/dataset_path.hpp"
#include "store/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

namespace bemcal::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using study::Dataset;
using Texts = std::vector<std::string>;
using Numbers = std::vector<double>;

Dataset texts(const std::string& leaf, const std::string& dim, Texts values) {
    return {"office/loop/" + leaf, {dim}, {values.size()}, {}, std::move(values)};
}

Dataset numbers(const std::string& leaf, const std::string& dim, Numbers values) {
    return {"office/loop/" + leaf, {dim}, {values.size()}, std::move(values), {}};
}

/// n, cv_rmse, nmbe, rmse of gas and of the air temperature (mean 20 degC).
Numbers metrics(double gas, double air, bool is_measured) {
    if (!is_measured) return {0, nan, nan, nan, 0, nan, nan, nan};
    return {8760, gas, 0.5 * gas, 3, 8760, air / 20, -0.1 * air / 20, air};
}

/// [model x period x resolution x channel x metric]; the plain, before and after.
Numbers fit(bool is_held_out) {
    Numbers all;
    for (const double scale : {4.0, 2.0, 1.0})
        for (const bool is_measured : {true, is_held_out})
            for (const double by : {1.0, 0.5}) {
                const Numbers one =
                    metrics(0.1 * scale * by, 0.3 * scale * by, is_measured);
                all.insert(all.end(), one.begin(), one.end());
            }
    return all;
}

void add_effect(store::ResultFile& result, bool is_adequate) {
    const auto add = [&](Dataset dataset) {
        result.datasets.push_back(std::move(dataset));
    };
    add(texts("effect", "effect", {"wind infiltration"}));
    add(texts("effect_hook", "effect", {"infiltration"}));
    add(texts("effect_driver", "effect", {"wind"}));
    add(texts("effect_shape", "effect", {"wind above 3 m/s"}));
    add(texts("effect_gate", "effect", {"always"}));
    add(texts("effect_unit", "effect", {"1/h per m/s"}));
    add(texts("effect_class", "effect",
              {"stack infiltration; wind infiltration; outdoor shift"}));
    add(numbers("effect_class_of", "class_member", {0, 0, 0}));
    add(texts("effect_class_member", "class_member",
              {"stack infiltration", "wind infiltration", "outdoor shift"}));
    add(numbers("effect_class_probability", "class_member", {0.25, 0.6, 0.15}));
    add(texts("effect_separates", "effect", {"calm and windy nights apart"}));
    add(texts("effect_section", "effect",
              {"[[effect]]\nname = \"wind infiltration\"\ncoefficient = 0.083\n"}));
    add(texts("effect_value_of", "effect_value", {"gas", "cost"}));
    add(numbers("effect_value_effect", "effect_value", {0, 0}));
    add(texts("effect_value_unit", "effect_value", {"kWh/a", "currency/a"}));
    add(numbers("effect_value", "effect_value", {1200, 96}));
    add(numbers("effect_value_least", "effect_value", {900, 72}));
    add(numbers("effect_value_most", "effect_value", {1500, 120}));
    add(numbers("effect_coefficient", "effect", {0.083}));
    add(numbers("effect_least", "effect", {0.079}));
    add(numbers("effect_most", "effect", {0.087}));
    add(numbers("effect_gain", "effect", {412}));
    add(numbers("effect_adequate", "effect", {is_adequate ? 1.0 : 0.0}));
    add(texts("measurement", "measurement", {"room temperature by the hour", "gas"}));
    add(texts("measurement_question", "measurement", {"wind, or stack?", "u_wall"}));
    add(texts("measurement_kind", "measurement", {"name", "parameter"}));
    add(texts("measurement_from", "measurement", {"1 January", "1 May"}));
    add(numbers("measurement_weeks", "measurement", {1, 4}));
    add(numbers("measurement_now", "measurement", {0.6, 0.9}));
    add(numbers("measurement_then", "measurement", {0.97, 0.88}));
    add(numbers("measurement_advised", "measurement", {1, 0}));
    add(texts("effect_doubt", "effect",
              {is_adequate ? "" : "its probability is below 0.9"}));
}

void add_background(store::ResultFile& result) {
    const auto add = [&](Dataset dataset) {
        result.datasets.push_back(std::move(dataset));
    };
    add(texts("step_effect", "step",
              {"wind infiltration", "meter drift", "", "last fit"}));
    add(texts(
        "step_verdict", "step",
        {"accepted", "evidence below what noise shows", "nothing passes", "moved"}));
    add(numbers("step_gain", "step", {412, 11, 0, 0}));
    add(numbers("step_threshold", "step", {24, 24, 24, 0}));
    add(numbers("step_score", "step", {160, -4, 0, 0}));
    add({"office/loop/step_error",
         {"step", "channel"},
         {4, 2},
         {-0.31, 0.004, nan, nan, nan, nan, nan, nan},
         {}});
    add(texts("hook", "hook", {"infiltration", "gains"}));
    add(texts("driver", "driver", {"wind", "hour of the day"}));
    add({"office/loop/localisation",
         {"hook", "driver"},
         {2, 2},
         {3.4, 0.2, 0.5, 1.2},
         {}});
    add({"office/loop/localisation_after",
         {"hook", "driver"},
         {2, 2},
         {0.4, 0.2, 0.5, 1.1},
         {}});
    add(texts("power_effect", "power",
              {"faint", "clear", "thermal bridge", "ground", "roof"}));
    const std::string parameters = "the calibrated parameters themselves";
    add(texts("power_alias", "power",
              {"clear", "faint", "H_op", parameters, parameters}));
    add(texts("power_alias_kind", "power",
              {"effect", "effect", "same", "parameters", "parameters"}));
    add({"office/loop/least_detectability", {}, {}, {5}, {}});
    add({"office/loop/same_signature", {}, {}, {0.98}, {}});
    add(texts("power_bias_parameter", "power",
              {"u_wall", "u_wall", "u_wall", "u_wall", "u_roof"}));
    add(numbers("power_detectability", "power", {2, 95, 7, 6, 6}));
    add(numbers("power_visibility", "power", {0.5, 0.9, 0.01, 0.02, 0.03}));
    add(numbers("power_alias_correlation", "power", {0.4, 0.4, 1, 1, 1}));
    add(numbers("power_bias", "power", {0.1, -3.5, 1, 1, 1}));
    add(numbers("unexplained", "channel", {0.07, nan}));
    add(texts("unexplained_where", "channel", {"weekday mornings", ""}));
    add(texts("learned_schedule", "learned_schedule", {"work"}));
    add(texts(
        "learned_schedule_sentence", "learned_schedule",
        {"schedule work: Monday to Friday 8 to 19 h, Saturdays off; learned, nobody "
         "declared it"}));
    add(numbers("learned_hours_of", "learned_hours", {0, 0}));
    add(texts("learned_hours_days", "learned_hours", {"Monday to Friday", "Saturdays"}));
    add(numbers("learned_hours_from", "learned_hours", {8, 0}));
    add(numbers("learned_hours_until", "learned_hours", {19, 0}));
    add(numbers("learned_hours_probability", "learned_hours", {0.97, 1}));
    add(numbers("learned_hours_from_least", "learned_hours", {7, 0}));
    add(numbers("learned_hours_from_most", "learned_hours", {8, 0}));
    add(numbers("learned_hours_until_least", "learned_hours", {19, 0}));
    add(numbers("learned_hours_until_most", "learned_hours", {19, 0}));
    add(numbers("learned_hours_usual_from", "learned_hours", {7, 0}));
    add(numbers("learned_hours_usual_until", "learned_hours", {18, 0}));
}

store::ResultFile loop_result(bool is_held_out = true, bool is_adequate = true) {
    store::ResultFile result;
    const auto add = [&](Dataset dataset) {
        result.datasets.push_back(std::move(dataset));
    };
    add(texts("channel", "channel", {"gas", "air"}));
    add(texts("channel_unit", "channel", {"kWh", "degC"}));
    add(texts("model", "model", {"plain", "before", "after"}));
    add(texts("period", "period", {"training", "held_out"}));
    add(texts("resolution", "resolution", {"hourly", "monthly"}));
    add(texts("metric", "metric", {"n", "cv_rmse", "nmbe", "rmse"}));
    add({"office/loop/fit",
         {"model", "period", "resolution", "channel", "metric"},
         {3, 2, 2, 2, 4},
         fit(is_held_out),
         {}});
    add(texts("parameter", "parameter", {"u_wall"}));
    add(texts("parameter_unit", "parameter", {"-"}));
    add(numbers("parameter_prior_mean", "parameter", {1}));
    add(numbers("parameter_prior_sd", "parameter", {0.2}));
    add({"office/loop/parameter_value",
         {"model", "parameter"},
         {3, 1},
         {1.4, 1.3, 1.05},
         {}});
    add({"office/loop/parameter_sd",
         {"model", "parameter"},
         {3, 1},
         {0.05, 0.04, 0.03},
         {}});
    add(texts("structure", "structure", {"standard", "second mass"}));
    add(numbers("structure_score", "structure", {1.31, 0.94}));
    add({"office/loop/kind", {}, {}, {}, {"loop"}});
    add({"office/loop/structure_chosen", {}, {}, {}, {"second mass"}});
    add(texts("refinement", "refinement", {"second mass"}));
    add(texts("refinement_is", "refinement", {"a slower mass behind the first"}));
    add(texts("decision_series", "decision", {"gas", "ground"}));
    add(texts("decision_finding", "decision",
              {"60 h of the same value", "one class with u_floor"}));
    add(texts("decision_action", "decision", {"masked", "told apart where it is large"}));
    add(texts("decision_kind", "decision", {"data", "class"}));
    add_effect(result, is_adequate);
    add_background(result);
    return result;
}

/// Runs of spaces as one.
std::string squeezed(const std::string& text) {
    std::istringstream words(text);
    std::string out;
    for (std::string word; words >> word;) out += (out.empty() ? "" : " ") + word;
    return out;
}

testing::AssertionResult says(const std::string& text, const std::string& phrase) {
    if (squeezed(text).find(phrase) != std::string::npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << "no \"" << phrase << "\" in\n" << text;
}

TEST(LoopTables, EveryDatasetIsOneOfTheLayout) {
    for (const Dataset& dataset : loop_result().datasets)
        EXPECT_NO_THROW(store::layout_of(dataset)) << dataset.path;
}

TEST(LoopTables, BeginWithTheErrorsOfWhatWasHeldOut) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(says(text, "office/loop: 1 effect found that the description lacks"));
    EXPECT_TRUE(
        says(text,
             "error in held_out, before and after: gas from 20.0 to 10.0 % (plain "
             "40.0), air from 0.60 to 0.30 K (plain 1.20)"));
}

TEST(LoopTables, SayWhereNothingWasHeldOut) {
    const std::string text = tables_of(loop_result(false));
    EXPECT_TRUE(says(text, "no readings were held out"));
    EXPECT_EQ(text.find("held_out"), std::string::npos) << text;
}

TEST(LoopTables, HaveErrorsAndBiasesOfEachChannelWithATemperatureInKelvin) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(says(text, "held_out gas hourly 8760 40.0 20.0 10.0 20.0 10.0 5.0 %"));
    EXPECT_TRUE(
        says(text, "training air monthly 8760 0.60 0.30 0.15 -0.06 -0.03 -0.01 K"));
}

TEST(LoopTables, AnEffectHasItsIntervalItsLikesAndWhatWouldTellThemApart) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(says(text, "wind infiltration 0.083 0.079 to 0.087 1/h per m/s 412 yes"));
    EXPECT_TRUE(says(text, "enters at infiltration, wind above 3 m/s"));
    EXPECT_NE(text.find("\n    [[effect]]\n    name = \"wind infiltration\"\n    "
                        "coefficient = 0.083\n"),
              std::string::npos);
    EXPECT_TRUE(says(
        text,
        "or else: stack infiltration (probability 0.25); outdoor shift (probability 0.15)"));
    EXPECT_TRUE(says(text, "what would tell: calm and windy nights apart"));
    EXPECT_EQ(text.find("NOT adequate"), std::string::npos);
}

TEST(LoopTables, AnEffectHasWhatItBrings) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(says(text, "wind infiltration gas 1200 900 to 1500 kWh/a"));
    EXPECT_TRUE(says(text, "cost 96 72 to 120 currency/a"));
}

TEST(LoopTables, WhatToMeasureNextStandsWithItsWorth) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(says(text,
                     "wind, or stack? room temperature by the hour 1 week from 1 "
                     "January 60 % 97 %"));
    EXPECT_EQ(text.find("4 weeks from 1 May"), std::string::npos);  // hardly more
    EXPECT_TRUE(says(text, "no measurement that was tried says much more of: u_wall"));
}

TEST(LoopTables, AnEffectThatIsNotAdequateSaysWhy) {
    const std::string text = tables_of(loop_result(true, false));
    EXPECT_TRUE(says(text, "1/h per m/s 412 NO"));
    EXPECT_TRUE(says(text, "NOT adequate: its probability is below 0.9, so that"));
}

TEST(LoopTables, TheSearchEndsWithItsReason) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(says(text, "1 wind infiltration 412 24 160 gas -31.0 accepted"));
    EXPECT_TRUE(says(text, "2 meter drift 11 24 -4 - evidence"));
    EXPECT_TRUE(says(text, "the search ended: nothing passes"));
}

TEST(LoopTables, ParametersMoveInStandardDeviationsOfTheirPriors) {
    EXPECT_TRUE(says(tables_of(loop_result()),
                     "u_wall - 1 +- 0.2 1.4 1.3 +- 0.04 1.05 +- 0.03 -1.25"));
}

TEST(LoopTables, HoursThatNobodyWroteDownStandByTheDay) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(
        says(text, "work Monday to Friday 8 (7 to 8) 19 (19 to 19) 7 to 18 0.97"));
    EXPECT_TRUE(says(text, "work Saturdays off - off 1.00"));
    EXPECT_TRUE(says(text,
                     "schedule work: Monday to Friday 8 to 19 h, Saturdays off; learned, "
                     "nobody declared it"));
}

TEST(LoopTables, ThePowerTableNamesWhatCannotBeSeenOrToldApart) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(says(text, "clear 95 90.0 % faint 0.4 u_wall -3.5 thermal bridge 7"));
    EXPECT_TRUE(
        says(text, "would not be seen in these data (detectability below 5): faint"));
    EXPECT_TRUE(says(text, "cannot be told apart: thermal bridge and H_op"));
    EXPECT_TRUE(says(text,
                     "the calibrated parameters themselves do nearly the same as (told "
                     "apart only where large): "
                     "ground, roof"));
}

Dataset& dataset_of(store::ResultFile& result, const std::string& leaf) {
    return *std::ranges::find(result.datasets, "office/loop/" + leaf, &Dataset::path);
}

TEST(LoopTables, LimitsAreThoseOfTheResult) {
    store::ResultFile result = loop_result();
    dataset_of(result, "least_detectability").values = {50};
    dataset_of(result, "same_signature").values = {0.3};
    const std::string text = tables_of(result);
    EXPECT_TRUE(says(text,
                     "would not be seen in these data (detectability below 50): faint, "
                     "thermal bridge, ground, roof"));
    EXPECT_TRUE(
        says(text, "cannot be told apart: faint and clear; thermal bridge and H"));
    EXPECT_EQ(text.find("do nearly the same"), std::string::npos) << text;
}

TEST(LoopTables, ClassesAreToldByTheirKindAndNotByTheirWords) {
    store::ResultFile result = loop_result();
    dataset_of(result, "decision_kind").texts = {"class", "data"};
    const std::string text = tables_of(result);
    EXPECT_TRUE(
        says(text, "ground: one class with u_floor: told apart where it is large"));
    EXPECT_FALSE(says(text, "60 h of the same value"));
}

TEST(LoopTables, OfAResultOfBeforeListsKindsAndLimitsWereStoredAreTheSame) {
    store::ResultFile result = loop_result();
    std::erase_if(result.datasets, [](const Dataset& d) {
        return store::leaf_of(d.path) == "effect_class_probability";
    });
    const std::string now = tables_of(result);
    std::erase_if(result.datasets, [](const Dataset& d) {
        const std::string leaf = store::leaf_of(d.path);
        return leaf.starts_with("effect_class_") || leaf == "decision_kind" ||
               leaf == "power_alias_kind" || leaf == "least_detectability" ||
               leaf == "same_signature";
    });
    EXPECT_EQ(tables_of(result), now);
}

TEST(LoopTables, ADoubtThatIsNotStoredIsNotMadeUp) {
    store::ResultFile result = loop_result(true, false);
    std::erase_if(result.datasets, [](const Dataset& d) {
        return d.path.find("effect_doubt") != std::string::npos;
    });
    const std::string text = tables_of(result);
    EXPECT_TRUE(says(text, "NOT adequate, so that its name is only the nearest one"));
}

TEST(LoopTables, AlarmsStandFromTheLoudestOn) {
    EXPECT_TRUE(says(tables_of(loop_result()),
                     "infiltration wind 3.4 0.4 gains hour of the day 1.2 1.1"));
}

TEST(LoopTables, WhatTheDataChecksSaidAlreadyIsNotSaidAgain) {
    store::ResultFile result = loop_result();
    EXPECT_TRUE(says(tables_of(result), "gas: 60 h of the same value: masked"));
    EXPECT_FALSE(says(tables_of(result), "one class with u_floor"));
    for (const char* leaf : {"series", "finding", "action"})
        result.datasets.push_back({std::string("office/data/") + leaf,
                                   {"decision"},
                                   {1},
                                   {},
                                   {"60 h of the same value"}});
    const std::string text = tables_of(result);
    EXPECT_EQ(text.find("masked"), std::string::npos) << text;
}

TEST(LoopTables, OfALongStructureTheEndIsShown) {
    store::ResultFile result = loop_result();
    dataset_of(result, "structure").texts[0] =
        "surfaces + sky of Hay and Davies + gains to air + emitter + glass by angle";
    const std::string text = tables_of(result);
    EXPECT_TRUE(says(text, ".. + gains to air + emitter + glass by angle 1.31"));
    EXPECT_FALSE(says(text, "surfaces + sky"));
}

TEST(LoopTables, StructuresDataAndWhatIsLeftAreThere) {
    const std::string text = tables_of(loop_result());
    EXPECT_TRUE(says(text, "second mass 0.94 chosen"));
    EXPECT_TRUE(says(text, "second mass: a slower mass behind the first"));
    EXPECT_TRUE(says(text, "gas: 60 h of the same value: masked"));
    EXPECT_TRUE(says(text, "gas 7.0 % weekday mornings"));
}

TEST(LoopTables, FindingNothingIsAResultAndWhatIsNotKnownADash) {
    store::ResultFile result = loop_result();
    std::erase_if(result.datasets, [](const Dataset& d) {
        return d.path.find("effect") != std::string::npos;
    });
    const std::string text = tables_of(result);
    EXPECT_TRUE(says(text, "no effect found that passes"));
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(LoopTables, FitIntoAHundredColumns) {
    std::istringstream lines(tables_of(loop_result(true, false)));
    for (std::string line; std::getline(lines, line);)
        EXPECT_LE(line.size(), 100U) << line;
}

}  // namespace
}  // namespace bemcal::report
