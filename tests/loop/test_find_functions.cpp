/// Functions that a building's readings show, from a loop that seeks no effect with a
/// name.
#include "loop/find_functions.hpp"
#include "loop/loop.hpp"
#include "loop/windy_model.hpp"
#include "study/find.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;
using test::gains_of_the_morning, test::measure, test::windy_case;

namespace {

LoopOptions functions_only() {
    LoopOptions options;
    options.block_days = 7;
    options.try_structures = false;
    options.most_effects = 0;
    return options;
}

std::vector<Dataset> searched(const Case& made, const LoopOptions& options) {
    const std::vector<Case> buildings = {made};
    const auto stage = make_loop("loop", buildings, options);
    return stage->conclude({stage->run(0)}).datasets;
}

/// CV(RMSE) by the hour of the first meter: [plain, before, after][training, held out].
double error_of(const std::vector<Dataset>& datasets, std::size_t model,
                std::size_t period) {
    const Dataset& fit = test::find(datasets, "fit");
    const std::size_t n_periods = fit.shape[1], n_resolutions = fit.shape[2],
                      n_channels = fit.shape[3], n_metrics = fit.shape[4];
    return fit
        .values[((model * n_periods + period) * n_resolutions * n_channels) * n_metrics +
                1];
}

}  // namespace

TEST(FindFunctions, HoursThatNothingNamesAreForetold) {
    Case made = windy_case();
    measure(made, gains_of_the_morning(), 8, 3);
    const auto datasets = searched(made, functions_only());
    const auto& names = test::find(datasets, "function").texts;
    ASSERT_FALSE(names.empty());
    EXPECT_NE(names[0].find("by hour"), std::string::npos) << names[0];
    EXPECT_LT(error_of(datasets, 2, 1), 0.8 * error_of(datasets, 1, 1));
    EXPECT_LT(error_of(datasets, 2, 0), 0.8 * error_of(datasets, 1, 0));
    // No effect is claimed.
    EXPECT_TRUE(test::find(datasets, "effect").texts.empty());
}

TEST(FindFunctions, WhereTheModelIsTheBuildingNothingIsLaidToThem) {
    Case made = windy_case();
    measure(made, gains_of_the_morning(), 0, 3);
    const auto datasets = searched(made, functions_only());
    EXPECT_LT(error_of(datasets, 2, 1), 1.01 * error_of(datasets, 1, 1));
    for (const double size : test::find(datasets, "function_size").values)
        EXPECT_LT(size, 0.3);
}

TEST(FindFunctions, NoneAreSoughtWhereTheJobWantsNone) {
    Case made = windy_case();
    measure(made, gains_of_the_morning(), 8, 3);
    LoopOptions options = functions_only();
    options.functions = false;
    EXPECT_TRUE(test::find(searched(made, options), "function").texts.empty());
}

namespace {

/// Heated to 21 degC at all hours, as the description has it.
Case heated_case() {
    Case made = windy_case();
    made.building.zones[0].thermostat.heating_set_point = {21, 0, -1};
    return made;
}

/// By 3 K more from 0 to 10 h, which the description has not.
effects::Effect heated_more_by_night() {
    effects::Effect effect = gains_of_the_morning();
    effect.name = "set-point";
    effect.hook = effects::Hook::heating_set_point;
    effect.shape = {effects::Form::within, 0, 10};
    effect.least = -3;
    effect.most = 3;
    return effect;
}

/// From a day of the period that is held out on it is cooled to 21.2 degC.
void cool_more_when_held_out(Case& made) {
    physics::Profile cooled;
    cooled.name = "cooled_more";
    cooled.is_series = true;
    cooled.axis = made.weather.axis;
    const int from = 24 * (test::n_training + 5);
    for (int k = 0; k < cooled.axis.n_steps; ++k)
        cooled.values.push_back(k < from ? 0 : 1);
    made.profiles.push_back(cooled);
    made.building.zones[0].thermostat.cooling_set_point = {
        21.2, 30, static_cast<int>(made.profiles.size()) - 1};
}

bool are_at_set_points(const std::vector<std::string>& functions) {
    return std::ranges::any_of(functions, [](const std::string& name) {
        return name.find("set-point") != std::string::npos;
    });
}

}  // namespace

// Heating would rise above what it is cooled to there; cooling gives way.
TEST(FindFunctions, AtSetPointsStayWhereAnotherPeriodHasThemMeet) {
    Case made = heated_case();
    measure(made, heated_more_by_night(), 3, 3);
    cool_more_when_held_out(made);
    const auto datasets = searched(made, functions_only());
    EXPECT_TRUE(are_at_set_points(test::find(datasets, "function").texts));
    EXPECT_TRUE(std::isfinite(error_of(datasets, 2, 1)));
}

// Linear steps move the parameters; where they end, the simulation has nothing to gain
// from others.
TEST(FindFunctions, ParametersEndWhereTheSimulationWantsThem) {
    Case made = windy_case();
    measure(made, gains_of_the_morning(), 60, 3);
    const LoopData data(made, functions_only());
    Place place = make_place(data, {}, data.drive);
    Standing standing =
        calibrate(data, place, {}, std::vector<double>(place.unknowns.size()));
    const auto found = find_functions(data, place, standing);
    ASSERT_FALSE(found.empty());
    Standing more = standing;
    refit(data, more, to_settle);
    ASSERT_FALSE(more.fit.failed);
    EXPECT_LT(standing.fit.objective - more.fit.objective, 1);
}

TEST(FindFunctions, AModelIsNoBetterThanItExplainsWhatItHasSeen) {
    test::WindyModel model({"wind infiltration"});
    Standing standing = model.standing;
    const double unseen = deviance(model.data.targets, standing.noise, standing.left_out);
    EXPECT_EQ(score_of_halves(model.data, standing), unseen);
    std::swap(standing.left_out, standing.residuals);
    EXPECT_EQ(score_of_halves(model.data, standing), unseen);
}

// Of two meters that count whole: what an error rises by, with or without what the other
// gains.
TEST(FindFunctions, AMeterMayLoseOnePercentOrInExchange) {
    Case made = windy_case();
    measure(made, gains_of_the_morning(), 0, 3);
    made.meters.push_back(made.meters[0]);
    const LoopData data(made, functions_only());
    const auto with_errors = [&](double first, double second) {
        Standing standing;
        standing.noise.resize(2);
        standing.left_out.assign(data.targets.size(), first);
        std::fill(standing.left_out.begin() +
                      static_cast<std::ptrdiff_t>(data.targets.first[1]),
                  standing.left_out.end(), second);
        standing.residuals.assign(data.targets.size(), 0);
        return standing;
    };
    const Standing without = with_errors(1, 1);
    EXPECT_TRUE(spares_meters(data, without, with_errors(1, 1.0099)));
    EXPECT_FALSE(spares_meters(data, without, with_errors(1, 1.0101)));
    EXPECT_TRUE(spares_meters(data, without, with_errors(0.8, 1.0299)));
    EXPECT_FALSE(spares_meters(data, without, with_errors(0.8, 1.0301)));
}
