#include "loop/stored_loop.hpp"
#include "study/find.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;

namespace {

std::vector<std::string> names_of(const StoredLoop::Effect& effect) {
    std::vector<std::string> names;
    names.reserve(effect.members.size());
    for (const auto& member : effect.members) names.push_back(member.name);
    return names;
}

StoredLoop made() {
    StoredLoop loop;
    loop.channels = {{"gas", "kWh", "mornings", 0.07}, {"air", "degC", ""}};
    loop.models = {"plain", "before", "after"};
    loop.periods = {"training"};
    loop.parameters = {{"u_wall", "-", 1, 0.2}};
    loop.parameter_value.resize({3, 1});
    loop.parameter_value.set({StoredLoop::after, 0}, 1.05);
    loop.fit.resize({3, 1, 2, 2, 4});
    loop.fit.set({StoredLoop::before, 0, StoredLoop::monthly, 1, StoredLoop::nmbe}, -0.1);
    loop.effects.resize(2);
    loop.effects[0].name = "wind";
    loop.effects[0].members = {{"wind", 0.7}, {"stack", 0.2}};
    loop.effects[0].class_in_words = "wind; stack";
    loop.effects[1].name = "blinds";
    loop.effects[1].members = {{"blinds"}};
    loop.effects[1].adequate = 1;
    loop.functions = {{"gains by wind", "gains", "wind", "W/m2", "m/s", 0.4, 20}};
    loop.function_points = {{0, 1.5, bemcal::nan, 0.2, 0.1, 0.3},
                            {0, 4, bemcal::nan, 0.6, 0.4, 0.8}};
    loop.seen = {{"wind", "ground", "effect", "u_wall", 60, 0.9, 0.4, -3}};
    loop.decisions = {{"gas", "zeros", "masked", "data"},
                      {"ground", "one class with u_floor", "kept", "class"}};
    loop.structure_chosen = "sky";
    loop.refinements = {{"sky", "the sky's temperature below the air's"}};
    loop.least_detectability = 4;
    return loop;
}

}  // namespace

TEST(StoredLoop, ComesBackAsItWas) {
    const auto datasets = datasets_of("office/loop", made(), {});
    const StoredLoop back = stored_loop(datasets, "office/loop");
    ASSERT_EQ(back.channels.size(), 2U);
    EXPECT_EQ(back.channels[0].unexplained, 0.07);
    EXPECT_EQ(back.channels[1].unit, "degC");
    EXPECT_EQ(back.models, made().models);
    EXPECT_EQ(back.parameters[0].prior_sd, 0.2);
    EXPECT_EQ(back.parameter_value.at({StoredLoop::after, 0}), 1.05);
    EXPECT_EQ(
        back.fit.at({StoredLoop::before, 0, StoredLoop::monthly, 1, StoredLoop::nmbe}),
        -0.1);
    ASSERT_EQ(back.effects.size(), 2U);
    EXPECT_EQ(names_of(back.effects[0]), names_of(made().effects[0]));
    EXPECT_EQ(back.effects[0].members[1].probability, 0.2);
    EXPECT_TRUE(std::isnan(back.effects[1].members[0].probability));
    EXPECT_FALSE(back.effects[0].is_adequate());
    EXPECT_TRUE(back.effects[1].is_adequate());
    EXPECT_EQ(back.functions.at(0).driver_unit, "m/s");
    ASSERT_EQ(back.function_points.size(), 2U);
    EXPECT_EQ(back.function_points[1].at, 4);
    EXPECT_EQ(back.function_points[1].most, 0.8);
    EXPECT_EQ(back.seen[0].alias_kind, name_of(AliasKind::effect));
    EXPECT_FALSE(back.decisions[0].is_of_class());
    EXPECT_TRUE(back.decisions[1].is_of_class());
    EXPECT_EQ(back.structure_chosen, "sky");
    ASSERT_EQ(back.refinements.size(), 1U);
    EXPECT_EQ(back.refinements[0].what, "the sky's temperature below the air's");
    EXPECT_EQ(back.least_detectability, 4);
    EXPECT_EQ(back.same_signature, decisions::same_signature);
}

TEST(StoredLoop, HasItsFitByModelPeriodResolutionChannelAndMetric) {
    const auto datasets = datasets_of("a/loop", made(), {});
    const study::Dataset& fit = test::find(datasets, "fit");
    EXPECT_EQ(fit.shape, (std::vector<std::size_t>{3, 1, 2, 2, 4}));
    EXPECT_EQ(fit.values[(((1 * 1 + 0) * 2 + 1) * 2 + 1) * 4 + 2], -0.1);
}

TEST(StoredLoop, OfAPeriodHasEveryHourOfEveryModel) {
    StoredPeriod period{"training", {physics::Seconds{}, physics::Seconds{}}, {1, 2}, {}};
    period.channels.push_back({"gas", {3, 4}});
    period.channels[0].simulated.resize({3, 2});
    const auto datasets = datasets_of("a/loop", made(), {period});
    EXPECT_EQ(test::find(datasets, "training/outdoor_temperature").values,
              (std::vector<double>{1, 2}));
    EXPECT_EQ(test::find(datasets, "training/gas/measured").values,
              (std::vector<double>{3, 4}));
    EXPECT_EQ(test::find(datasets, "training/gas/simulated").shape,
              (std::vector<std::size_t>{3, 2}));
}

TEST(StoredLoop, OfAPeriodHasItsMonths) {
    StoredPeriod period{"training", {physics::Seconds{}}, {1}, {}};
    period.months = {physics::Seconds{}, physics::Seconds{std::chrono::hours(31 * 24)}};
    period.channels.push_back({"gas", {3}});
    period.channels[0].month = {10, 20};
    const auto datasets = datasets_of("a/loop", made(), {period});
    for (const char* leaf : {"training/month", "training/gas/month_predicted"}) {
        const study::Dataset& months = test::find(datasets, leaf);
        EXPECT_EQ(months.dims, std::vector<std::string>{"month"});
        EXPECT_EQ(months.shape, std::vector<std::size_t>{2});
    }
    EXPECT_EQ(test::find(datasets, "training/month").values[1], 31 * 86400.0);
}

TEST(StoredLoop, KeepsWhatEffectsBringPartsOfAJobAndMeasurements) {
    StoredLoop loop = made();
    loop.effect_values = {{1, "gas", "kWh/a", 5, 4, 6}};
    loop.job_parts = {{"hours", "weekdays = [0]"}};
    loop.measurements = {{"U_wall", "parameter", "gas", "1 May", 2, 0.9, 0.4, 1}};
    const StoredLoop back = stored_loop(datasets_of("a/loop", loop, {}), "a/loop");
    ASSERT_EQ(back.effect_values.size(), 1U);
    EXPECT_EQ(back.effect_values[0].of, "gas");
    EXPECT_EQ(back.effect_values[0].effect, 1);
    EXPECT_EQ(back.effect_values[0].most, 6);
    ASSERT_EQ(back.job_parts.size(), 1U);
    EXPECT_EQ(back.job_parts[0].section, "weekdays = [0]");
    ASSERT_EQ(back.measurements.size(), 1U);
    EXPECT_EQ(back.measurements[0].question, "U_wall");
    EXPECT_EQ(back.measurements[0].weeks, 2);
    EXPECT_EQ(back.measurements[0].then, 0.4);
}

TEST(StoredLoop, WithoutDatasetsIsEmpty) {
    const StoredLoop none = stored_loop({}, "a/loop");
    EXPECT_TRUE(none.effects.empty());
    EXPECT_EQ(none.structure_chosen, "");
    EXPECT_NE(none.misfit, none.misfit);  // NaN
}

TEST(StoredLoop, OfNoEffectHasItsListsAllTheSame) {
    const auto datasets = datasets_of("a/loop", {}, {});
    for (const char* leaf :
         {"effect", "effect_gain", "effect_class_member", "step_effect"})
        EXPECT_EQ(test::find(datasets, leaf).shape, std::vector<std::size_t>{0}) << leaf;
}

TEST(StoredLoop, MembersOfNoEffectAreLeftOut) {
    auto datasets = datasets_of("a/loop", made(), {});
    const auto of =
        std::ranges::find(datasets, "a/loop/effect_class_of", &study::Dataset::path);
    of->values = {0, 7, 1};
    EXPECT_EQ(names_of(stored_loop(datasets, "a/loop").effects[0]),
              std::vector<std::string>{"wind"});
}

TEST(StoredLoop, NamesOfDatasetsAndDimensionsStandBesidePeriods) {
    const auto names = stored_names();
    for (const char* name : {"fit", "resolution", "effect_class_member", "class_member",
                             "structure_chosen", "misfit"})
        EXPECT_EQ(std::ranges::count(names, name) > 0, true) << name;
}
