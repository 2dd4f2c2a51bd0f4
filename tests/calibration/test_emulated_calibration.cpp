#include "calibration/emulated_calibration.hpp"
#include "calibration/emulated_period.hpp"
#include "calibration/screening.hpp"
#include "calibration/staged.hpp"
#include "sampling/normal.hpp"
#include "stats/sobol_sequence.hpp"
#include "study/find.hpp"
#include "study/room_program.hpp"
#include "study/simulated_hours.hpp"
#include "study/simulator_run.hpp"
#include "study/small_case.hpp"
#include "support/stage_answers.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::calibration {
namespace {

using study::Case;
using Texts = std::vector<std::string>;

/// Whose sun heats within the hour.
class Room : public test::Room {
  public:
    explicit Room(const Case& building, int fails_each = 0)
        : test::Room(building, fails_each, 1) {}
};

const std::vector<double> truth{1.2, 20, 0.5};
constexpr double noise = 0.05;  ///< sd of a reading [kWh]

/// Two weeks to calibrate on and one that no stage sees, with a meter that the program
/// knows nothing of.
Case measured() {
    Case made = test::small_case();
    made.periods = {{"first", test::day(0), test::day(7)},
                    {"later", test::day(7), test::day(14)},
                    {"unseen", test::day(14), test::day(21)}};
    std::vector<double> heat = Room(made).heat(truth);
    Stream random(7, 0, 0);
    for (double& value : heat) value += noise * sampling::standard_normal(random);
    const physics::TimeAxis axis =
        study::axis_of(made, {"all", test::day(0), test::day(21)});
    made.meters = {
        {"electricity", physics::Quantity::electricity, physics::Interval::hourly, axis,
         std::vector(heat.size(), 1.0)},
        {"heating", physics::Quantity::heating, physics::Interval::hourly, axis, heat}};
    return made;
}

CalibrationStage stage(const char* name, const char* from, Texts periods,
                       Texts parameters) {
    CalibrationStage made{name, from, std::move(periods), std::move(parameters)};
    made.fit.evaluations = 800;
    made.fit.objective = Objective::fraction;
    made.fit.seed = 5;
    return made;
}

StagedOptions two_stages() {
    StagedOptions options;
    options.stages = {
        stage("losses", initial_values, {"first"}, {"u", "sun"}),
        stage("all", "losses", {"first", "later"}, {"u", "set_point", "sun"})};
    options.validation = {{"unseen", "all"}};
    options.at_once = false;
    return options;
}

std::unique_ptr<study::Stage> stage_around(const Case& building, int n_runs,
                                           int fails_each = 0) {
    return make_emulated_calibration(
        "small/stages", building, std::make_shared<Room>(building, fails_each),
        {"stages", n_runs, 3, {"first", "later"}},
        [](const Case& of_program, const MakePeriodModel& model) {
            return make_staged("small/stages", of_program, two_stages(), model);
        });
}

struct Made {
    std::vector<study::Dataset> datasets;
    std::string shortfall;
    const std::vector<double>& numbers(const char* leaf) const {
        return test::find(datasets, leaf).values;
    }
    const Texts& texts(const char* leaf) const {
        return test::find(datasets, leaf).texts;
    }
};

Made made(const Case& building, int n_runs, int fails_each = 0) {
    const auto all = stage_around(building, n_runs, fails_each);
    const auto answers = test::answers_of(*all);
    return {all->conclude(answers).datasets, all->shortfall(answers)};
}

TEST(EmulatedPeriod, ForetellsErrorsAsRunsOfTheProgramHaveThem) {
    const Case building = case_of_simulator(measured(), Room(measured()));
    const Room room(building);
    const study::SeriesLayout layout(building, {0});
    const Matrix points = stats::scrambled_sobol_points(0, 60, 3, 1);
    Matrix series(0, layout.size());
    for (std::size_t r = 0; r < points.rows; ++r)
        series.add_row(layout.series(
            building, {room.heat(study::values_at(points.row(r), building.parameters))}));
    const auto emulator = std::make_shared<const emulator::SeriesEmulator>(
        points, series, layout.weights(building), 1 - 1e-6);
    const study::Period& period = building.periods[1];
    const auto model = emulated_period_model(building, period, layout, emulator);
    Matrix at(0, 3);
    at.add_row(std::vector{1.4, 21.0, 0.4});
    const kernel::PointAnswer answer = model->evaluate(at, model->all()).at(0);
    const auto plain = study::compared(
        study::readings_of_hours(building, period,
                                 {physics::Quantity::heating, physics::Interval::hourly},
                                 room.heat(at.row(0))),
        study::axis_of(building, period), model->readings()[0]);
    const auto fit =
        study::fit_of(model->readings()[0], answer.errors[0], answer.monthly_errors[0]);
    EXPECT_EQ(fit.own.n, 7 * 24);
    EXPECT_NEAR(fit.own.rmse, plain.fit.own.rmse, 0.03 * plain.fit.own.rmse);
    EXPECT_NEAR(fit.monthly.nmbe, plain.fit.monthly.nmbe, 0.01);
    // The close look and the sums are the same emulator.
    const auto look = model->look(building, period, at.row(0), {});
    EXPECT_NEAR(look.meters[0].fit.own.rmse, fit.own.rmse, 1e-9);
}

TEST(EmulatedCalibration, StagesFindWhatTheReadingsWereMadeOf) {
    const Case building = measured();
    const Made result = made(building, 48);
    EXPECT_EQ(result.shortfall, "");
    EXPECT_EQ(result.texts("kind"), Texts{"stages"});
    const auto& value = result.numbers("calibration_value");
    EXPECT_EQ(value[1], 20.5) << "the first stage leaves the set-point alone";
    const std::vector<double> last(value.begin() + 3, value.begin() + 6);
    const Room room(building);
    for (std::size_t k = 0; k < 3; ++k) {
        const physics::Parameter& parameter = room.parameters()[k];
        EXPECT_NEAR(last[k], truth[k], 0.03 * (parameter.most - parameter.least))
            << parameter.name;
        std::printf("measured: %s %.4f, truth %.4f\n", parameter.name.c_str(), last[k],
                    truth[k]);
    }
    EXPECT_EQ(result.texts("simulator_run").size(), 49U);
    EXPECT_EQ(result.texts("simulator_run").back(), "best point");
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(result.numbers("simulator_run_value")[48 * 3 + k], last[k], 1e-9);
}

/// By a run of the program at the last stage's values, made by hand.
TEST(EmulatedCalibration, TheLastRunSaysWhatTheBestPointIsWorth) {
    const Case building = measured();
    const Made result = made(building, 48);
    EXPECT_EQ(result.texts("best_run_output"),
              (Texts{"heating in first, calibrated on", "heating in later, calibrated on",
                     "heating in unseen, not seen"}));
    const auto& value = result.numbers("calibration_value");
    const auto heat = Room(building).heat(std::span(value).subspan(3, 3));
    for (std::size_t p = 0; p < 3; ++p) {
        const study::Period& period = building.periods[p];
        const auto own = study::hours_in(building, period, heat),
                   read = study::readings_of(building, period)[1].values;
        const double error = 100 * stats::relative_error(stats::metrics_of(own, read));
        EXPECT_NEAR(result.numbers("best_run_value")[p], error, 1e-6);
        EXPECT_NEAR(result.numbers("best_run_foretold")[p], error, 0.2 * error);
    }
}

/// All its points are run, here and now, to see which is the best.
TEST(EmulatedCalibration, AScreeningFindsTheBestOfItsPoints) {
    const Case building = measured();
    ScreeningOptions options;
    options.n_points = 500;
    options.points_per_item = 200;
    const auto all = make_emulated_calibration(
        "small/screening", building, std::make_shared<Room>(building),
        {"screening", 48, 3, {"first"}},
        [&](const Case& of_program, const MakePeriodModel& model) {
            return make_screening("small/screening", of_program, options, model);
        });
    const auto answers = test::answers_of(*all);
    const Made result{all->conclude(answers).datasets, all->shortfall(answers)};
    const auto read = study::readings_of(building, building.periods[0])[1].values;
    const auto error_at = [&](std::span<const double> point) {
        return stats::relative_error(stats::metrics_of(
            study::hours_in(building, building.periods[0], Room(building).heat(point)),
            read));
    };
    const auto& points = result.numbers("points");
    double least = error_at(std::span(points).first(3));
    for (std::size_t r = 1; r <= options.n_points; ++r)
        least = std::min(least, error_at(std::span(points).subspan(3 * r, 3)));
    const auto best = std::span(result.numbers("best_parameters")).first(3);
    EXPECT_LT(error_at(best), 1.05 * least);
    EXPECT_NEAR(result.numbers("best_run_value")[0], 100 * error_at(best), 1e-6);
    EXPECT_EQ(result.texts("meter"), Texts{"heating"});
}

TEST(EmulatedCalibration, RunsThatFailAreToldAndLeftOut) {
    const Made result = made(measured(), 48, 5);
    const auto& failures = result.texts("simulator_run_failure");
    EXPECT_GT(std::ranges::count(failures, "it was told to fail"), 0);
    EXPECT_EQ(result.shortfall, "");
    EXPECT_NEAR(result.numbers("calibration_value")[4], truth[1], 0.3);
}

TEST(EmulatedCalibration, TooFewRunsAreAShortfallAndFewerAMistake) {
    const Made result = made(measured(), 48, 1);
    EXPECT_EQ(result.shortfall,
              "too few runs of the simulator succeeded for a calibration");
    EXPECT_EQ(result.texts("kind"), Texts{"stages"});
    EXPECT_THROW(stage_around(measured(), 8), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::calibration
