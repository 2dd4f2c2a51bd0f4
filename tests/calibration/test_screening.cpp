#include "calibration/screening.hpp"
#include "physics/simulate.hpp"
#include "stats/metrics.hpp"
#include "study/find.hpp"
#include "study/small_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::find;
using test::has;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Conclusion conclusion_of(const Stage& stage) {
    std::vector<ItemAnswer> answers;
    for (int item = 0; item < stage.n_items(); ++item) answers.push_back(stage.run(item));
    return stage.conclude(answers);
}

std::vector<Dataset> run(const Stage& stage) {
    return conclusion_of(stage).datasets;
}

/// Gas (hourly) and electricity (daily) of the model itself at `point`, some readings
/// missing.
Case case_measured_at(const std::vector<double>& point) {
    Case made = test::small_case();
    const Period all{"all", test::day(7), test::day(24)};
    const physics::Drive drive = drive_of(made, all);
    physics::Building building = made.building;
    physics::apply(made.building, made.parameters, point, building);
    const auto trajectory = physics::simulate(building, drive);
    const physics::TimeAxis axis = axis_of(made, all);
    auto gas = physics::predict(building, drive, trajectory, physics::Quantity::gas);
    for (std::size_t k = 30; k < 40; ++k) gas[k] = nan;
    const auto electricity =
        physics::predict(building, drive, trajectory, physics::Quantity::electricity);
    const auto bounds = physics::interval_bounds(axis, physics::Interval::daily);
    const auto days =
        physics::aggregate(electricity, bounds, physics::Quantity::electricity);
    std::vector<double> daily(gas.size(), nan);
    for (std::size_t d = 0; d < days.size(); ++d)
        daily[static_cast<std::size_t>(bounds[d])] = days[d];
    made.meters = {{"gas", physics::Quantity::gas, physics::Interval::hourly, axis, gas},
                   {"electricity", physics::Quantity::electricity,
                    physics::Interval::daily, axis, daily}};
    return made;
}

calibration::ScreeningOptions options_of(std::size_t n_points, bool keep_points) {
    calibration::ScreeningOptions options;
    options.n_points = n_points;
    options.points_per_item = 100;
    options.seed = 5;
    options.keep_points = keep_points;
    options.n_best = 7;
    options.hourly_outputs = {physics::Quantity::heating,
                              physics::Quantity::air_temperature};
    return options;
}

const std::vector<double> truth{0.6, 0.6, 21.6};

TEST(Screening, BeginsWithTheNominalPointAndFindsABetterOne) {
    const auto stage = calibration::make_screening(
        "small/screening", case_measured_at(truth), options_of(300, true));
    EXPECT_EQ(stage->n_items(), 4);
    EXPECT_EQ(stage->n_simulations(), 602);
    const auto datasets = run(*stage);
    const auto& points = find(datasets, "points");
    EXPECT_EQ(points.shape, (std::vector<std::size_t>{301, 3}));
    EXPECT_EQ(points.values[0], 0.8);
    EXPECT_EQ(points.values[2], 21);
    const auto& score = find(datasets, "score").values;
    const auto best = std::ranges::min_element(score);
    EXPECT_EQ(find(datasets, "best_point").values[0], best - score.begin());
    EXPECT_EQ(find(datasets, "best_score").values[0], *best);
    EXPECT_LT(*best, score[0] / 4);
    EXPECT_TRUE(std::ranges::is_sorted(find(datasets, "best_score").values));
}

TEST(Screening, HandsOnItsBestPointsWithHowFarTheyReachAndTheirErrors) {
    const auto stage = calibration::make_screening(
        "small/screening", case_measured_at(truth), options_of(300, true));
    const auto [datasets, summaries] = conclusion_of(*stage);
    ASSERT_EQ(summaries.size(), 1U);
    const Summary& found = summaries[0];
    EXPECT_EQ(found.study, "small/screening");
    EXPECT_EQ(found.failure, "");
    EXPECT_EQ(found.points.parameters, find(datasets, "parameter").texts);
    EXPECT_EQ(found.points.rows.values, find(datasets, "best_parameters").values);
    EXPECT_EQ(found.points.rows.rows, 7U);
    EXPECT_EQ(found.score, find(datasets, "best_score").values[0]);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(found.values[k].value, found.points.rows(0, k));
        for (std::size_t r = 0; r < 7; ++r) {
            EXPECT_LE(found.values[k].low, found.points.rows(r, k));
            EXPECT_GE(found.values[k].high, found.points.rows(r, k));
        }
    }
    ASSERT_EQ(found.fits.size(), 4U);  // two periods of two meters
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(found.fits[k].period, k / 2);
        EXPECT_EQ(found.fits[k].meter, k % 2);
        EXPECT_EQ(found.fits[k].before, find(datasets, "cv_rmse").values[k]);
        EXPECT_EQ(found.fits[k].cv_rmse, find(datasets, "best_cv_rmse").values[k]);
        EXPECT_EQ(found.fits[k].nmbe, find(datasets, "best_nmbe").values[k]);
    }
}

TEST(Screening, HasNoErrorWhereTheReadingsCameFrom) {
    Case made = case_measured_at({0.8, 0.5, 21});  // the nominal point
    const auto datasets =
        run(*calibration::make_screening("s", made, options_of(50, true)));
    EXPECT_EQ(find(datasets, "best_point").values[0], 0);
    EXPECT_LT(find(datasets, "score").values[0], 1e-18);
    const auto& meets = find(datasets, "meets_guideline_14").values;
    EXPECT_EQ(meets[0], 1);  // training, hourly
    EXPECT_EQ(meets[2], 1);  // held out, hourly
}

/// Metrics of a stored candidate from its stored series.
stats::FitMetrics of_series(const std::vector<Dataset>& datasets,
                            const std::string& folder, std::size_t candidate) {
    const auto& measured = find(datasets, folder + "/measured").values;
    const auto& simulated = find(datasets, folder + "/simulated").values;
    return stats::metrics_of(
        std::span(simulated).subspan(candidate * measured.size(), measured.size()),
        measured);
}

// fit [candidate, period, meter, metric] comes from the plain simulation, cv_rmse [point,
// period, meter] from the kernel's sums: both must be what the stored series say.
TEST(Screening, StoresSeriesFromWhichItsMetricsFollow) {
    const auto datasets = run(
        *calibration::make_screening("s", case_measured_at(truth), options_of(64, true)));
    const auto& fit = find(datasets, "fit").values;
    const auto &cv_rmse = find(datasets, "cv_rmse").values,
               &nmbe = find(datasets, "nmbe").values,
               &mape = find(datasets, "mape").values;
    const auto best = static_cast<std::size_t>(find(datasets, "best_point").values[0]);
    const char* folders[] = {"training/gas", "training/electricity", "held_out/gas",
                             "held_out/electricity"};
    for (std::size_t candidate = 0; candidate < 2; ++candidate)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto expected = of_series(datasets, folders[k], candidate);
            const std::size_t row = (candidate == 0 ? 0 : best) * 4 + k;
            EXPECT_GT(expected.n, k % 2 == 0 ? 150 : 6) << folders[k];
            EXPECT_NEAR(cv_rmse[row], expected.cv_rmse, 1e-9) << folders[k];
            EXPECT_NEAR(nmbe[row], expected.nmbe, 1e-9) << folders[k];
            EXPECT_NEAR(mape[row], expected.mape, 1e-7 * expected.mape) << folders[k];
            EXPECT_EQ(fit[(candidate * 4 + k) * 8 + 2], expected.cv_rmse) << folders[k];
            EXPECT_EQ(fit[(candidate * 4 + k) * 8], expected.n) << folders[k];
        }
    EXPECT_EQ(find(datasets, "held_out/hourly/heating").shape,
              (std::vector<std::size_t>{2, 7 * 24}));
}

// The weather's own hours stand in the result, whether or not other hourly series do.
TEST(Screening, StoresTheOutdoorTemperatureOfEachPeriodWithItsTime) {
    const Case made = case_measured_at(truth);
    calibration::ScreeningOptions options = options_of(16, false);
    options.hourly_outputs.clear();
    const auto datasets = run(*calibration::make_screening("s", made, options));
    for (const Period& period : made.periods) {
        const auto& time = find(datasets, period.name + "/hourly/time").values;
        const auto& theta_e =
            find(datasets, period.name + "/hourly/outdoor_temperature").values;
        ASSERT_EQ(time.size(), static_cast<std::size_t>(axis_of(made, period).n_steps));
        ASSERT_EQ(theta_e.size(), time.size());
        EXPECT_EQ(time[0], static_cast<double>(period.from.time_since_epoch().count()));
        const auto first = static_cast<std::size_t>(
            (period.from - made.weather.axis.begin_of(0)).count() / 3600);
        for (std::size_t hour = 0; hour < time.size(); ++hour)
            EXPECT_EQ(theta_e[hour], made.weather.theta_e[first + hour]) << hour;
    }
}

TEST(Screening, SumsMonthsOverTheHoursThatHaveReadings) {
    const auto datasets = run(
        *calibration::make_screening("s", case_measured_at(truth), options_of(16, true)));
    const auto &monthly = find(datasets, "monthly_cv_rmse").values,
               &fit = find(datasets, "monthly_fit").values;
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(monthly[k], fit[k * 8 + 2], 1e-9) << k;
}

TEST(Screening, CountsThePointsThatMeetGuideline14) {
    const auto datasets = run(*calibration::make_screening("s", case_measured_at(truth),
                                                           options_of(200, true)));
    const auto& meets = find(datasets, "meets_guideline_14").values;
    const auto& count = find(datasets, "guideline_14_count").values;
    for (std::size_t k = 0; k < 4; ++k) {
        double sum = 0;
        for (std::size_t point = 0; point < 201; ++point) sum += meets[4 * point + k];
        EXPECT_EQ(count[k], sum);
    }
    EXPECT_GT(count[0], 0);
    EXPECT_LT(count[0], 201);
}

TEST(Screening, KeepsTheSameBestAndCountsWithoutThePoints) {
    const Case made = case_measured_at(truth);
    const auto all = run(*calibration::make_screening("s", made, options_of(250, true))),
               best =
                   run(*calibration::make_screening("s", made, options_of(250, false)));
    EXPECT_FALSE(has(best, "points"));
    EXPECT_FALSE(has(best, "score"));
    for (const char* leaf : {"best_point", "best_score", "best_parameters", "best_nmbe",
                             "guideline_14_count", "fit", "n_points"})
        EXPECT_EQ(find(all, leaf).values, find(best, leaf).values) << leaf;
}

TEST(Screening, StoresFailedPointsWithTheirReason) {
    Case made = case_measured_at(truth);
    made.parameters.push_back(
        test::parameter(made.building, "zone.office.mass_area_ratio", 0.01, 2.5, 2.5));
    const auto datasets =
        run(*calibration::make_screening("s", made, options_of(300, true)));
    const auto n_failed = find(datasets, "n_failed").values[0];
    ASSERT_GT(n_failed, 0);
    EXPECT_LT(n_failed, 30);
    const auto& score = find(datasets, "score").values;
    EXPECT_EQ(n_failed,
              std::ranges::count_if(score, [](double s) { return std::isnan(s); }));
    const auto first = static_cast<std::size_t>(find(datasets, "failed_point").values[0]);
    EXPECT_TRUE(std::isnan(score[first]));
    EXPECT_NE(find(datasets, "failed_reason").texts[0], "");
}

TEST(Screening, GoesOnWithoutAnItemThatFailedAsAWhole) {
    const auto stage =
        calibration::make_screening("s", case_measured_at(truth), options_of(250, true));
    std::vector<ItemAnswer> answers;
    for (int item = 0; item < stage->n_items(); ++item)
        answers.push_back(stage->run(item));
    answers[1] = {{}, {}, "the node went away"};
    const auto datasets = stage->conclude(answers).datasets;
    EXPECT_EQ(find(datasets, "n_failed").values[0], 100);
    EXPECT_TRUE(std::isnan(find(datasets, "score").values[150]));
    EXPECT_EQ(find(datasets, "failed_reason").texts[0], "the node went away");
}

TEST(Screening, ConcludesWhereEveryPointFails) {
    Case made = case_measured_at(truth);
    made.parameters.push_back(test::parameter(
        made.building, "zone.office.mass_area_ratio", 0.001, 0.002, 0.001));
    const auto [datasets, summaries] =
        conclusion_of(*calibration::make_screening("s", made, options_of(20, false)));
    EXPECT_EQ(summaries.at(0).failure,
              "no point could be simulated: " + find(datasets, "failed_reason").texts[0]);
    EXPECT_EQ(summaries[0].points.rows.rows, 0U);
    EXPECT_EQ(find(datasets, "n_failed").values[0], 21);
    EXPECT_FALSE(has(datasets, "best_point"));
    EXPECT_TRUE(std::isnan(find(datasets, "training/gas/simulated").values[0]));
}

TEST(Screening, NeedsAReadingInTheFirstPeriod) {
    Case made = case_measured_at(truth);
    for (Meter& meter : made.meters) std::ranges::fill(meter.values, nan);
    EXPECT_THROW(calibration::make_screening("s", made, options_of(10, true)),
                 std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::study
