#include "calibration/staged.hpp"
#include "study/find.hpp"
#include "study/measured_case.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::find;
using Texts = std::vector<std::string>;

/// As `run` does it, on one rank; an item may fail as a whole.
std::vector<ItemAnswer> answers_of(Stage& stage, int failed = -1) {
    std::vector<ItemAnswer> answers;
    for (int first = 0, n = stage.n_items();;) {
        for (int item = first; item < first + n; ++item)
            answers.push_back(item == failed ? ItemAnswer{{}, {}, "the node went away"}
                                             : stage.run(item));
        const auto next = stage.next_round(answers);
        if (!next) return answers;
        first += n;
        n = next->n_items;
        stage.begin_round(first, *next);
    }
}

std::vector<Dataset> run(Stage& stage) {
    return stage.conclude(answers_of(stage)).datasets;
}

constexpr const char* air = "zone.office.flow.air.air_change";
constexpr const char* glass = "glazing.window.solar_transmittance";
constexpr const char* set_point = "zone.office.heating_set_point";
const std::vector<double>& truth = test::true_values;

/// With two periods to calibrate on and one that no stage sees.
Case measured_case() {
    Case made = test::measured_case();
    made.periods = {{"training", test::day(7), test::day(12)},
                    {"later", test::day(12), test::day(17)},
                    {"unseen", test::day(17), test::day(24)}};
    return made;
}

calibration::CalibrationStage stage(const char* name, const char* from, Texts periods,
                                    Texts parameters) {
    calibration::CalibrationStage made{name, from, std::move(periods),
                                       std::move(parameters)};
    made.fit.evaluations = 400;
    made.fit.n_particles = 16;
    made.fit.objective = calibration::Objective::fraction;
    made.fit.seed = 5;
    return made;
}

calibration::StagedOptions two_stages() {
    calibration::StagedOptions options;
    options.stages = {
        stage("first", calibration::initial_values, {"training"}, {air, glass}),
        stage("second", "first", {"later"}, {set_point, air})};
    options.validation = {{"unseen", "second"}};
    options.at_once_evaluations = 1200;
    return options;
}

double at(const Dataset& dataset, std::size_t row, std::size_t column) {
    return dataset.values.at(row * dataset.shape.at(1) + column);
}

TEST(Staged, CarriesWhatAStageFoundToTheNext) {
    const auto datasets =
        run(*calibration::make_staged("s", measured_case(), two_stages()));
    const Dataset &start = find(datasets, "calibration_start"),
                  &value = find(datasets, "calibration_value");
    EXPECT_EQ(find(datasets, "calibration_stage").texts,
              (Texts{"first", "second", "at_once"}));
    EXPECT_EQ(start.shape, (std::vector<std::size_t>{3, 3}));
    EXPECT_EQ(at(start, 0, 0), 0.8);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(at(start, 1, k), at(value, 0, k)) << k;
    EXPECT_EQ(at(value, 0, 2), 21) << "left alone by the first stage";
    EXPECT_EQ(at(value, 1, 1), at(value, 0, 1)) << "left alone by the second";
    EXPECT_TRUE(std::isnan(at(find(datasets, "calibration_least"), 1, 1)));
    EXPECT_EQ(find(datasets, "calibration_evaluations").values,
              (std::vector<double>{400, 400, 1200}));
}

TEST(Staged, FindsAtOnceWhatMadeTheReadings) {
    const auto datasets =
        run(*calibration::make_staged("s", measured_case(), two_stages()));
    const Dataset &value = find(datasets, "calibration_value"),
                  &sd = find(datasets, "calibration_sd");
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(at(value, 2, k), truth[k], 0.02) << k;
        EXPECT_LT(at(sd, 2, k), 0.05) << k;
    }
}

/// Gas of the one, temperatures of the other: in whichever order, all at once is both.
TEST(Staged, AllAtOnceFitsTheMetersOfAllStages) {
    auto options = two_stages();
    for (auto& each : options.stages) each.parameters = {air, glass, set_point};
    options.stages[0].periods = options.stages[1].periods = {"training"};
    options.stages[0].fit.meters = {"gas"};
    options.stages[1].fit.meters = {"air_temperature"};
    const auto values = [&] {
        const auto datasets =
            run(*calibration::make_staged("s", measured_case(), options));
        const Dataset& value = find(datasets, "calibration_value");
        return std::vector<double>{at(value, 2, 0), at(value, 2, 1), at(value, 2, 2)};
    };
    const auto one = values();
    std::swap(options.stages[0].fit.meters, options.stages[1].fit.meters);
    const auto other = values();
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(one[k], truth[k], 0.02) << k;
        EXPECT_NEAR(other[k], truth[k], 0.02) << k;
    }
}

/// What ends is the last stage, not what all at once would have found.
TEST(Staged, IsJudgedByItsLastStage) {
    auto options = two_stages();
    for (auto& each : options.stages) each.parameters = {air, glass, set_point};
    options.at_once_evaluations = 1;
    const auto staged = calibration::make_staged("s", measured_case(), options);
    const auto conclusion = staged->conclude(answers_of(*staged));
    EXPECT_EQ(conclusion.summaries.at(0).shortfall.find("the bias of"), std::string::npos)
        << conclusion.summaries.at(0).shortfall;
}

/// Heat of one period that no point reaches, told once however many stages take it.
TEST(Staged, ThatEndsWithABiasBeyondTheGuidelineFallsShort) {
    Case made = measured_case();
    auto options = two_stages();
    options.at_once_evaluations = 0;
    for (auto& each : options.stages) each.fit.evaluations = 60;
    options.stages[1].periods = {"training", "later"};
    const auto shortfall = [&] {
        const auto staged = calibration::make_staged("s", made, options);
        return staged->conclude(answers_of(*staged)).summaries.at(0).shortfall;
    };
    EXPECT_EQ(shortfall().find("the bias of"), std::string::npos) << shortfall();
    const Meter& meter = made.meters[0];
    const int end = meter.axis.step_of(made.periods[0].to);
    for (int k = 0; k < end; ++k)
        made.meters[0].values[static_cast<std::size_t>(k)] *= 10;
    const std::string said = shortfall(),
                      bias = "the bias of " + meter.name + " in training";
    ASSERT_NE(said.find(bias), std::string::npos) << said;
    EXPECT_EQ(said.find(bias, said.find(bias) + 1), std::string::npos) << said;
}

TEST(Staged, JudgesOnAPeriodThatNoStageHasSeen) {
    const auto datasets =
        run(*calibration::make_staged("s", measured_case(), two_stages()));
    const auto of = [&](const std::string& path) -> const Dataset& {
        for (const Dataset& dataset : datasets)
            if (dataset.path == "s/validation/unseen/" + path) return dataset;
        throw std::out_of_range(path);
    };
    EXPECT_EQ(of("version").texts, (Texts{"initial", "second", "at_once"}));
    const Dataset& simulated = of("periods/unseen/air_temperature/simulated");
    const Dataset& measured = of("periods/unseen/air_temperature/measured");
    ASSERT_EQ(simulated.shape, (std::vector<std::size_t>{3, 168}));
    double square = 0;
    int n_within = 0;
    for (std::size_t k = 0; k < 168; ++k) {
        const double error = at(simulated, 0, k) - measured.values[k];
        square += error * error;
        n_within += std::abs(error) <= 0.5 ? 1 : 0;
    }
    const Dataset& fit = of("version_fit");  // [version, meter, metric]
    EXPECT_NEAR(fit.values.at(8 + 7), std::sqrt(square / 168), 1e-9);
    EXPECT_NEAR(of("share_within_half").values.at(1), n_within / 168.0, 1e-12);
    const std::vector<double>& share = of("error_share").values;
    const std::size_t n_levels = of("error_level").values.size();
    for (std::size_t k = 1; k < n_levels; ++k) EXPECT_GE(share[k], share[k - 1]);
    EXPECT_LT(fit.values.at(2 * 2 * 8 + 8 + 7), 0.1 * fit.values.at(8 + 7));
}

TEST(Staged, HoldsWhatAStageSetsFromThereOn) {
    calibration::StagedOptions options = two_stages();
    options.at_once = false;
    options.stages[0].set = {{set_point, 20.5}};
    options.stages[1].parameters = {air};
    const auto datasets = run(*calibration::make_staged("s", measured_case(), options));
    const Dataset& value = find(datasets, "calibration_value");
    EXPECT_EQ(at(value, 0, 2), 20.5);
    EXPECT_EQ(at(value, 1, 2), 20.5);
    EXPECT_TRUE(std::isnan(at(find(datasets, "calibration_least"), 0, 2)));
    options.stages[0].set = {{air, 0.5}};
    EXPECT_THROW(calibration::make_staged("s", measured_case(), options),
                 std::invalid_argument);
}

TEST(Staged, TakesPeriodsTogetherAndRangesAroundWhatWasCarriedOver) {
    calibration::StagedOptions options = two_stages();
    options.at_once = false;
    options.stages[0].periods = {"training", "later"};
    options.stages[0].ranges = {{air, 0.5, 0.7}};
    options.stages[1].around = 0.1;
    const auto datasets = run(*calibration::make_staged("s", measured_case(), options));
    const Dataset &least = find(datasets, "calibration_least"),
                  &most = find(datasets, "calibration_most"),
                  &value = find(datasets, "calibration_value");
    EXPECT_EQ(at(least, 0, 0), 0.5);
    EXPECT_EQ(at(most, 0, 0), 0.7);
    EXPECT_EQ(at(least, 1, 0), 0.9 * at(value, 0, 0));
    EXPECT_EQ(at(most, 1, 0), 1.1 * at(value, 0, 0));
    EXPECT_EQ(at(least, 1, 2), 20) << "the parameter's own range is narrower";
    EXPECT_EQ(find(datasets, "first/period").texts, (Texts{"training", "later"}));
}

// A belief that is sure and wrong holds against a day of independent errors, not against
// all readings.
TEST(Staged, WeighsPriorsAgainstIndependentErrors) {
    calibration::StagedOptions options = two_stages();
    options.at_once = false;
    for (calibration::CalibrationStage& each : options.stages)
        each.fit.objective = calibration::Objective::likelihood;
    Case made = measured_case();
    made.priors.resize(3, {{stats::PriorKind::uniform}, {}});
    made.priors[0].prior = {stats::PriorKind::normal, 0.8, 0.001, 0.3, 1.5};
    const auto air_found = [&](double hours) {
        options.stages[0].independent_hours = hours;
        return at(
            find(run(*calibration::make_staged("s", made, options)), "calibration_value"),
            0, 0);
    };
    EXPECT_NEAR(air_found(0), truth[0], 0.05);
    EXPECT_NEAR(air_found(8760), 0.8, 0.01);
}

TEST(Staged, TellsTheBoundThatAParameterEndsOn) {
    calibration::StagedOptions options = two_stages();
    options.at_once = false;
    options.stages[0].ranges = {{air, 0.7, 0.9}};  // the truth is 0.6
    const auto datasets = run(*calibration::make_staged("s", measured_case(), options));
    EXPECT_EQ(at(find(datasets, "calibration_at_bound"), 0, 0), -1);
    EXPECT_EQ(at(find(datasets, "calibration_at_bound"), 0, 2), 0);
}

TEST(Staged, BranchesFromAnEarlierStage) {
    calibration::StagedOptions options = two_stages();
    options.at_once = false;
    options.stages[1].from = calibration::initial_values;
    const auto datasets = run(*calibration::make_staged("s", measured_case(), options));
    EXPECT_EQ(at(find(datasets, "calibration_start"), 1, 1), 0.5);
}

TEST(Staged, GoesOnFromItsAnswersAlone) {
    const auto whole = calibration::make_staged("s", measured_case(), two_stages());
    const auto answers = answers_of(*whole);
    const auto resumed = calibration::make_staged("s", measured_case(), two_stages());
    const std::vector<ItemAnswer> half(answers.begin(), answers.begin() + 33);
    const auto next = resumed->next_round(half);
    ASSERT_TRUE(next.has_value());
    EXPECT_EQ(find(resumed->conclude(answers).datasets, "calibration_value").values,
              find(whole->conclude(answers).datasets, "calibration_value").values);
}

TEST(Staged, GoesOnWhereAnItemFailedAsAWhole) {
    const auto stage = calibration::make_staged("s", measured_case(), two_stages());
    const auto datasets = stage->conclude(answers_of(*stage, 0)).datasets;
    EXPECT_EQ(find(datasets, "n_failed").values[0], 16);
    EXPECT_EQ(find(datasets, "failed_point").values.back(), 15);
    EXPECT_NEAR(at(find(datasets, "calibration_value"), 2, 0), truth[0], 0.02);
}

TEST(Staged, JudgesTheStudiesBesideIt) {
    calibration::StagedOptions options = two_stages();
    options.at_once = false;
    options.beside = {"belief"};
    const auto stage = calibration::make_staged("small/s", measured_case(), options);
    Summary belief;
    belief.study = "small/belief";
    belief.values = {{glass, 0.6, 0.5, 0.7}, {"noise", 9, 8, 10}};
    stage->see({belief});
    const auto datasets = run(*stage);
    EXPECT_EQ(find(datasets, "unseen/version").texts,
              (Texts{"initial", "second", "belief"}));
}

TEST(Staged, LeavesOutAStudyBesideItThatFoundNothing) {
    calibration::StagedOptions options = two_stages();
    options.at_once = false;
    options.beside = {"belief", "no_study"};
    const auto stage = calibration::make_staged("small/s", measured_case(), options);
    Summary belief;
    belief.study = "small/belief";
    stage->see({belief});
    const auto datasets = run(*stage);
    EXPECT_EQ(find(datasets, "unseen/version").texts, (Texts{"initial", "second"}));
}

void expect_refusal(calibration::StagedOptions options, const std::string& words) {
    try {
        calibration::make_staged("s", measured_case(), std::move(options));
        FAIL() << words;
    } catch (const std::invalid_argument& error) {
        EXPECT_EQ(error.what(), words);
    }
}

TEST(Staged, AWeightIsOfTheMeterThatIsNamedInItsPlace) {
    const auto found = [](Texts meters, std::vector<double> weights) {
        calibration::StagedOptions options = two_stages();
        options.at_once = false;
        for (calibration::CalibrationStage& each : options.stages) {
            each.fit.evaluations = 60;
            each.fit.meters = meters;
            each.fit.meter_weights = weights;
        }
        const auto made = calibration::make_staged("staged", measured_case(), options);
        return find(run(*made), "calibration_objective").values;
    };
    const auto air = found({"air_temperature"}, {1});
    EXPECT_EQ(found({"air_temperature", "gas"}, {1, 0}), air);
    EXPECT_NE(found({"gas", "air_temperature"}, {1, 0}), air);
}

TEST(Staged, RefusesWhatCannotBe) {
    calibration::StagedOptions options = two_stages();
    options.validation = {{"later", "second"}};
    expect_refusal(options,
                   "the validation period later overlaps later, on which the stage "
                   "second calibrates");
    options = two_stages();
    options.stages[0].from = "second";
    expect_refusal(options,
                   "the stage first starts from second, which is no stage before it");
    options = two_stages();
    options.stages[1].parameters = {"height"};
    expect_refusal(options, "small has no parameter height, of the stage second");
    options = two_stages();
    options.stages[1].periods = {"winter"};
    expect_refusal(options, "small has no period winter");
    options = two_stages();
    options.stages[1].ranges = {{glass, 0.3, 0.4}};
    expect_refusal(options, std::string("the stage second has a range for ") + glass +
                                ", which it does not calibrate, or it is empty");
    options = two_stages();
    options.stages[1].fit.meters = {"water"};
    expect_refusal(options, "small has no meter \"water\"");
    options = two_stages();
    options.validation = {{"unseen", "third"}};
    expect_refusal(options,
                   "the validation period unseen takes the values of third, which is no "
                   "stage");
}

}  // namespace
}  // namespace bemcal::study
