#include "calibration/meter_goal.hpp"
#include "calibration/optimisation.hpp"
#include "optimise/fronts.hpp"
#include "study/analytic_simulator.hpp"
#include "study/find.hpp"
#include "study/measured_case.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::find;
using test::has;
using test::measured_case;

/// As `run` does it, on one rank: round after round.
Conclusion conclusion_of(Stage& stage) {
    std::vector<ItemAnswer> answers;
    for (int first = 0, n = stage.n_items();;) {
        for (int item = first; item < first + n; ++item)
            answers.push_back(stage.run(item));
        const auto next = stage.next_round(answers);
        if (!next) return stage.conclude(answers);
        first += n;
        n = next->n_items;
        stage.begin_round(first, *next);
    }
}

std::vector<Dataset> run(Stage& stage) {
    return conclusion_of(stage).datasets;
}

const std::vector<double>& truth = test::true_values;

calibration::OptimisationOptions options_of(std::size_t evaluations) {
    calibration::OptimisationOptions options;
    options.evaluations = evaluations;
    options.n_particles = 16;
    options.points_per_item = 5;
    options.seed = 3;
    return options;
}

TEST(Optimisation, FindsTheTruthThatMadeTheReadings) {
    const auto stage =
        calibration::make_optimisation("s", measured_case(), options_of(1500));
    const auto [datasets, summaries] = conclusion_of(*stage);
    const auto& best = find(datasets, "front_parameters").values;
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(best[k], truth[k], 0.02) << k;
        EXPECT_EQ(summaries.at(0).values.at(k).value, best[k]) << k;
    }
    EXPECT_EQ(find(datasets, "n_points").values[0], 1500);
    EXPECT_LT(find(datasets, "front_objective").values[0], 0.5);
    const auto& candidates = find(datasets, "candidate_parameters").values;
    EXPECT_EQ(candidates[0], 0.8);
    EXPECT_EQ(candidates[3], best[0]);
    EXPECT_EQ(find(datasets, "at_bound").values, std::vector<double>(3, 0));
}

/// Readings of the first meter that no point reaches.
TEST(Optimisation, ThatEndsWithABiasBeyondTheGuidelineFallsShort) {
    const auto shortfall = [](double factor) {
        Case made = measured_case();
        for (double& reading : made.meters[0].values) reading *= factor;
        const auto stage = calibration::make_optimisation("s", made, options_of(100));
        return conclusion_of(*stage).summaries.at(0).shortfall;
    };
    EXPECT_EQ(shortfall(1), "");
    const std::string said = shortfall(10);
    EXPECT_NE(said.find("the bias of " + measured_case().meters[0].name + " in training"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("beyond the 10 % of Guideline 14"), std::string::npos) << said;
}

TEST(Optimisation, GetsNoWorseFromRoundToRound) {
    const auto datasets =
        run(*calibration::make_optimisation("s", measured_case(), options_of(300)));
    const auto& best = find(datasets, "round_best").values;
    EXPECT_EQ(find(datasets, "round_end").values.back(), 300);
    EXPECT_TRUE(std::ranges::is_sorted(best, std::greater<>()));
    EXPECT_EQ(best.back(), std::ranges::min(find(datasets, "point_objective").values));
}

TEST(Optimisation, IsTheSameForAnyItemSizeAndForItemsOfAnySize) {
    calibration::OptimisationOptions options = options_of(200);
    const auto one = calibration::make_optimisation("s", measured_case(), options);
    const auto datasets = run(*one);
    options.points_per_item = 64;
    EXPECT_EQ(find(run(*calibration::make_optimisation("s", measured_case(), options)),
                   "points")
                  .values,
              find(datasets, "points").values);
    EXPECT_EQ(find(run(*calibration::make_optimisation("s", measured_case(), options)),
                   "front_objective")
                  .values,
              find(datasets, "front_objective").values);
}

TEST(Optimisation, TakesOnlyTheNamedParametersAndMeters) {
    calibration::OptimisationOptions options = options_of(150);
    options.parameters = {"glazing.window.solar_transmittance"};
    options.meters = {"gas"};
    const auto datasets =
        run(*calibration::make_optimisation("s", measured_case(), options));
    EXPECT_EQ(find(datasets, "parameter").texts, options.parameters);
    EXPECT_EQ(find(datasets, "front_parameters").values.size(), 1U);
    options.meters = {"water"};
    EXPECT_THROW(calibration::make_optimisation("s", measured_case(), options),
                 std::invalid_argument);
    options = options_of(10);
    options.parameters = {"height"};
    EXPECT_THROW(calibration::make_optimisation("s", measured_case(), options),
                 std::invalid_argument);
    options = options_of(10);
    options.meter_weights = {1, 2, 3};
    EXPECT_THROW(calibration::make_optimisation("s", measured_case(), options),
                 std::invalid_argument);
}

TEST(Optimisation, AWeightIsOfTheMeterThatIsNamedInItsPlace) {
    const auto error_of = [](std::vector<std::string> meters,
                             std::vector<double> weights) {
        calibration::OptimisationOptions options = options_of(10);
        options.meters = std::move(meters);
        options.meter_weights = std::move(weights);
        const calibration::MeterGoal goal(measured_case(), options);
        std::vector<std::string> failures;
        return goal.evaluate(nominal_row(goal.parameters()), failures).values[0];
    };
    const double gas = error_of({"gas"}, {1}), air = error_of({"air_temperature"}, {1});
    EXPECT_NE(gas, air);
    EXPECT_EQ(error_of({"gas", "air_temperature"}, {1, 0}), gas);
    EXPECT_EQ(error_of({"air_temperature", "gas"}, {1, 0}), air);
    EXPECT_EQ(error_of({"air_temperature", "gas"}, {0, 1}), gas);
    EXPECT_THROW(error_of({"gas", "gas"}, {1, 0}), std::invalid_argument);
}

TEST(Optimisation, TakesADiscreteParameterFromItsTable) {
    Case made = measured_case();
    made.priors.resize(3);
    made.priors[1].values = {0.3, 0.45, 0.6, 0.7};
    const auto datasets =
        run(*calibration::make_optimisation("s", made, options_of(1200)));
    EXPECT_EQ(find(datasets, "front_parameters").values[1], 0.6);
}

TEST(Optimisation, StoresFailedPointsAndGoesRoundThem) {
    Case made = measured_case();
    made.parameters.push_back(
        test::parameter(made.building, "zone.office.mass_area_ratio", 0.01, 0.4, 0.4));
    const auto datasets =
        run(*calibration::make_optimisation("s", made, options_of(400)));
    EXPECT_GT(find(datasets, "n_failed").values[0], 0);
    EXPECT_TRUE(std::isfinite(find(datasets, "front_objective").values[0]));
}

TEST(Optimisation, GoesOnWithoutAnItemThatFailedAsAWhole) {
    const auto stage =
        calibration::make_optimisation("s", measured_case(), options_of(16));
    std::vector<ItemAnswer> answers;
    for (int item = 0; item < stage->n_items(); ++item)
        answers.push_back(stage->run(item));
    answers[1] = {{}, {}, "the node went away"};
    const auto datasets = stage->conclude(answers).datasets;
    EXPECT_EQ(find(datasets, "n_failed").values[0], 5);
    EXPECT_EQ(find(datasets, "failed_point").values,
              (std::vector<double>{5, 6, 7, 8, 9}));
}

/// Paper 3: the errors of the fuels as objectives.
TEST(Optimisation, GivesAFrontOfTheMetersErrorsByNsga2) {
    calibration::OptimisationOptions options = options_of(0);
    options.method = calibration::OptimisationMethod::nsga2;
    options.n_population = 20;
    options.n_generations = 12;
    const auto datasets =
        run(*calibration::make_optimisation("s", measured_case(), options));
    EXPECT_EQ(find(datasets, "objective").texts,
              (std::vector<std::string>{"gas", "air_temperature"}));
    const auto& front = find(datasets, "front_objective");
    ASSERT_EQ(front.shape[1], 2U);
    Matrix rows(front.shape[0], 2);
    rows.values = front.values;
    EXPECT_EQ(optimise::sort_into_fronts(rows).size(), 1U);
    for (const double error : rows.values) EXPECT_GE(error, 0);
    EXPECT_LT(rows(0, 0), 5);
    EXPECT_FALSE(has(datasets, "round_best"));
}

TEST(Optimisation, HasNoPointBelowTheMeasuredTotalsWithSignedErrors) {
    calibration::OptimisationOptions options = options_of(0);
    options.method = calibration::OptimisationMethod::nsga2;
    options.errors = calibration::MeterError::signed_;
    options.n_population = 20;
    options.n_generations = 6;
    const auto datasets =
        run(*calibration::make_optimisation("s", measured_case(), options));
    int n_refused = 0;
    for (const double error : find(datasets, "point_objective").values) {
        n_refused += std::isnan(error) ? 1 : 0;
        EXPECT_FALSE(error < 0);
    }
    EXPECT_GT(n_refused, 0);
    EXPECT_EQ(find(datasets, "n_failed").values[0], 0);
}

/// Paper 2, eq. 1-4: CV(RMSD) in per cent and R2 as a fraction, and both as fractions.
/// power = 2 lights + 3 devices is to be 40, heat = 100 air + 10 (set_point - 10) - power
/// 500: lines of points hit both.
calibration::TargetAim analytic_aim() {
    return {std::make_shared<test::AnalyticSimulator>(9.0),
            {{"power", 40, 0}, {"heat", 500, 0}},
            {}};
}

TEST(Optimisation, HitsTheTargetsOfASimulator) {
    calibration::OptimisationOptions options = options_of(3000);
    options.parameters = {"lights", "devices", "air"};
    const auto datasets =
        run(*calibration::make_optimisation("s", analytic_aim(), options));
    EXPECT_EQ(find(datasets, "objective").texts, std::vector<std::string>{"distance"});
    EXPECT_LT(find(datasets, "round_best").values.back(), 1e-3);
    const auto& best = find(datasets, "nearest_parameters").values;
    ASSERT_EQ(best.size(), 3U);  // the set point stays at 5
    EXPECT_NEAR(2 * best[0] + 3 * best[1], 40, 1e-3);
    EXPECT_NEAR(100 * best[2], 500 + 50 + 40, 0.02);
    for (const double error : find(datasets, "nearest_target_error").values)
        EXPECT_LT(std::abs(error), 1e-3);
    EXPECT_GT(find(datasets, "n_failed").values[0], 0);  // air above 9
}

TEST(Optimisation, HasAnErrorForEachTargetByNsga2AndNoneBelowIfSigned) {
    for (const calibration::MeterError errors :
         {calibration::MeterError::absolute, calibration::MeterError::signed_}) {
        calibration::OptimisationOptions options = options_of(0);
        options.method = calibration::OptimisationMethod::nsga2;
        options.errors = errors;
        options.n_population = 20;
        options.n_generations = 40;
        const auto datasets =
            run(*calibration::make_optimisation("s", analytic_aim(), options));
        EXPECT_EQ(find(datasets, "objective").texts,
                  (std::vector<std::string>{"power", "heat"}));
        const auto& found = find(datasets, "nearest_target_error").values;
        EXPECT_LT(std::abs(found[0]) + std::abs(found[1]), 2);
        if (errors == calibration::MeterError::signed_) {
            EXPECT_GE(std::min(found[0], found[1]), 0);
        }
        for (const double value : find(datasets, "front_objective").values)
            EXPECT_GE(value, 0);  // and not NaN
    }
}

TEST(Optimisation, RefusesTargetsThatAreNotThereOrNoNumbersToAimAt) {
    calibration::TargetAim aim = analytic_aim();
    calibration::OptimisationOptions options = options_of(100);
    options.parameters = {"lights", "lifts"};
    EXPECT_THROW(calibration::make_optimisation("s", aim, options),
                 std::invalid_argument);
    options.parameters.clear();
    options.method = calibration::OptimisationMethod::nsga2;
    options.errors = calibration::MeterError::cv_rmse;
    EXPECT_THROW(calibration::make_optimisation("s", aim, options),
                 std::invalid_argument);
    options.errors = calibration::MeterError::absolute;
    aim.targets[1].measured = 0;
    EXPECT_THROW(calibration::make_optimisation("s", aim, options),
                 std::invalid_argument);
    aim.targets[1] = {"water", 3, 0};
    EXPECT_THROW(calibration::make_optimisation("s", aim, options),
                 std::invalid_argument);
    aim.targets.clear();
    EXPECT_THROW(calibration::make_optimisation("s", aim, options),
                 std::invalid_argument);
}

TEST(WeightedError, IsPaper2s) {
    stats::FitMetrics metrics;
    metrics.n = 100;
    metrics.cv_rmse = 0.0244;
    metrics.r2 = 0.98;
    calibration::OptimisationOptions options;
    EXPECT_DOUBLE_EQ(calibration::weighted_error(metrics, options),
                     0.7 * 2.44 + 0.3 * 0.02);
    options.objective = calibration::Objective::fraction;
    EXPECT_DOUBLE_EQ(calibration::weighted_error(metrics, options),
                     0.7 * 0.0244 + 0.3 * 0.02);
    options.r2_weight = 0;
    EXPECT_DOUBLE_EQ(calibration::weighted_error(metrics, options), 0.7 * 0.0244);
}

}  // namespace
}  // namespace bemcal::study
