#include "calibration/grid.hpp"
#include "calibration/grid_rounds.hpp"
#include "study/analytic_simulator.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::AnalyticSimulator;
using Values = std::vector<double>;

/// The truth: lights 4.3, devices 6.2, air 3.1, set-point 17.4.
calibration::GridOptions made_options() {
    calibration::GridOptions options;
    options.grids = {{{"lights", {3, 4, 5, 6}},
                      {"devices", {4, 5, 6, 7, 8}},
                      {"air", {1, 3, 5}},
                      {"set_point", {16, 17, 18}},
                      {"colour", {1, 2}}}};
    options.targets = {{"power", 2 * 4.3 + 3 * 6.2},
                       {"heat", 310 + 74 - (2 * 4.3 + 3 * 6.2)}};
    options.points_per_item = 17;
    return options;
}

/// Runs a stage with its rounds as `run` would, on one rank.
struct Finished {
    std::vector<ItemAnswer> answers;
    std::vector<Dataset> datasets;
    std::vector<Summary> found;
    std::string shortfall;
    std::vector<int> items_of_rounds;
};

Finished run_all(const calibration::GridOptions& options, double fails_above = 1e9) {
    const auto stage = calibration::make_grid(
        "grid", std::make_shared<AnalyticSimulator>(fails_above), options);
    Finished run;
    int first = 0, count = stage->n_items();
    for (;;) {
        run.items_of_rounds.push_back(count);
        for (int k = 0; k < count; ++k) run.answers.push_back(stage->run(first + k));
        const auto round = stage->next_round(run.answers);
        if (!round) break;
        first += count;
        count = round->n_items;
        stage->begin_round(first, *round);
    }
    Conclusion conclusion = stage->conclude(run.answers);
    run.datasets = std::move(conclusion.datasets);
    run.found = std::move(conclusion.summaries);
    run.shortfall = stage->shortfall(run.answers);
    return run;
}

const Values& values_of(const Finished& run, const std::string& path) {
    for (const Dataset& dataset : run.datasets)
        if (dataset.path == "grid/" + path) return dataset.values;
    throw std::logic_error("no dataset " + path);
}

const std::vector<std::string>& texts_of(const Finished& run, const std::string& path) {
    for (const Dataset& dataset : run.datasets)
        if (dataset.path == "grid/" + path) return dataset.texts;
    throw std::logic_error("no dataset " + path);
}

TEST(GridStudy, RunsEveryPointOfTheGivenGridsAndNoOther) {
    calibration::GridOptions options = made_options();
    options.grids.push_back({{"lights", {4, 4.5}}, {"devices", {6, 6.25}}, {"air", {3}}});
    options.nearest.k = 3;
    options.most_stages = 2;
    const Finished run = run_all(options);
    EXPECT_EQ(values_of(run, "stage_points"), (Values{360, 4}));
    EXPECT_EQ(run.items_of_rounds, (std::vector<int>{22, 1}));
    EXPECT_EQ(texts_of(run, "ended_by")[0], "all stages are done");
    const Values& held = values_of(run, "stage_2/grid_points");
    EXPECT_EQ(held[3], 5);  // the set-point stays nominal there
}

TEST(GridStudy, ComesToTheTargetErrorByItself) {
    calibration::GridOptions options = made_options();
    options.target_error = 0.05;
    options.budget = 5000;
    const Finished run = run_all(options);
    EXPECT_EQ(run.shortfall, "");
    EXPECT_EQ(texts_of(run, "ended_by")[0], "the target error is reached");
    const Values& errors = values_of(run, "stage_error");
    EXPECT_LE(errors.back(), 0.05);
    EXPECT_GT(errors.front(), 0.05);
    double n = 0;
    for (const double points : values_of(run, "stage_points")) n += points;
    EXPECT_LE(n, 5000);
}

TEST(GridStudy, ErrorsAreInPerCentOfTheMeasured) {
    calibration::GridOptions options = made_options();
    options.most_stages = 1;
    const Finished run = run_all(options);
    const Values &outputs = values_of(run, "stage_1/target_output"),
                 &errors = values_of(run, "stage_1/target_error"),
                 &distance = values_of(run, "stage_1/distance");
    EXPECT_NEAR(errors[0], 100 * (outputs[0] / 27.2 - 1), 1e-12);
    EXPECT_NEAR(distance[0], std::hypot(errors[0], errors[1]), 1e-9);
}

TEST(GridStudy, TellsADeterminedParameterFromAnInsensitiveOne) {
    calibration::GridOptions options = made_options();
    options.grids[0][0].second = {3, 4.1, 5.3, 6.2};  // no two of them in one place
    options.nearest.k = 2;
    options.nearest.radius = 1e-6;  // the two colours of one point lie in one place
    options.nearest.threshold = 0;
    options.most_stages = 1;
    const Finished run = run_all(options);
    const auto& roles = texts_of(run, "stage_1/parameter_role");
    EXPECT_EQ(roles[2], "determined");   // the air
    EXPECT_EQ(roles[4], "insensitive");  // the colour
    const Values& total = values_of(run, "stage_1/grid_total_order");
    EXPECT_GT(total[5 + 2], 0.9);
    EXPECT_NEAR(total[4], 0, 1e-9);
    EXPECT_NEAR(total[5 + 4], 0, 1e-9);
}

TEST(GridStudy, FixesAParameterThatKeepsOneValueAndRefinesTheOthers) {
    calibration::GridOptions options = made_options();
    const AnalyticSimulator simulator;
    calibration::GridRounds rounds(simulator.parameters(), options);
    const calibration::Grid grid = rounds.first_grid();
    Matrix outputs;
    std::vector<std::string> failures;
    simulator.evaluate(calibration::points_of(grid, 0, calibration::size_of(grid)),
                       outputs, failures);
    rounds.add(grid, outputs);
    const auto next = rounds.next();
    ASSERT_TRUE(next.grid);
    EXPECT_EQ((*next.grid)[2], (Values{3}));
    const calibration::GridStage& stage = rounds.stages()[0];
    for (std::size_t p = 0; p < grid.size(); ++p)
        if (stage.roles[p] == calibration::ParameterRole::open) {
            EXPECT_EQ((*next.grid)[p],
                      calibration::with_midpoints(grid[p], stage.surviving[p], {0, 20}));
        }
}

TEST(GridStudy, HandsOnTheNeighboursInItsLastStage) {
    calibration::GridOptions options = made_options();
    options.most_stages = 2;
    const Finished run = run_all(options);
    const FoundPoints& found = run.found.at(0).points;
    EXPECT_EQ(run.found[0].study, "grid");
    EXPECT_EQ(found.parameters, texts_of(run, "parameter"));
    const Values& points = values_of(run, "stage_2/grid_points");
    const Values& neighbours = values_of(run, "stage_2/neighbour");
    ASSERT_EQ(found.rows.rows, neighbours.size());
    for (std::size_t r = 0; r < neighbours.size(); ++r)
        for (std::size_t k = 0; k < 5; ++k)
            EXPECT_EQ(found.rows(r, k),
                      points[static_cast<std::size_t>(neighbours[r]) * 5 + k]);
}

TEST(GridStudy, NeverSpendsMoreThanItsBudget) {
    for (const long long budget : {360LL, 400LL, 700LL}) {
        calibration::GridOptions options = made_options();
        options.budget = budget;
        options.target_error = 1e-9;
        const Finished run = run_all(options);
        double n = 0;
        for (const double points : values_of(run, "stage_points")) n += points;
        EXPECT_LE(n, static_cast<double>(budget));
        EXPECT_NE(run.shortfall, "");
    }
}

TEST(GridStudy, FailedPointsAreCountedAndNeverNearest) {
    calibration::GridOptions options = made_options();
    options.most_stages = 1;
    const Finished run = run_all(options, 2.0);  // the air of the truth fails
    EXPECT_EQ(values_of(run, "n_failed")[0], 240);
    const Values& points = values_of(run, "stage_1/grid_points");
    for (const double neighbour : values_of(run, "stage_1/neighbour"))
        EXPECT_EQ(points[static_cast<std::size_t>(neighbour) * 5 + 2], 1);
    EXPECT_EQ(values_of(run, "failed_point")[0], 6);
}

TEST(GridStudy, EndsWhereEveryPointFails) {
    calibration::GridOptions options = made_options();
    const Finished run = run_all(options, 0.5);
    EXPECT_EQ(run.found.at(0).points.rows.rows, 0U);
    EXPECT_EQ(texts_of(run, "ended_by")[0], "no point was answered");
    EXPECT_EQ(run.shortfall, "no point was answered");
}

TEST(GridStudy, ScaledDistancesDivideByTheSpreadOfTheFirstGrid) {
    calibration::GridOptions options = made_options();
    options.distance = calibration::GridDistance::scaled;
    options.targets[1].scale = 2;
    options.most_stages = 1;
    const Finished run = run_all(options);
    const Values& scale = values_of(run, "target_scale");
    EXPECT_EQ(scale[1], 2);
    const Values &errors = values_of(run, "stage_1/target_error"),
                 &distance = values_of(run, "stage_1/distance");
    double sum = 0, square = 0;
    for (std::size_t r = 0; r < 360; ++r) {
        sum += errors[2 * r] / 360;
        square += errors[2 * r] * errors[2 * r] / 360;
    }
    EXPECT_NEAR(scale[0], std::sqrt(square - sum * sum), 1e-9);
    EXPECT_NEAR(distance[7], std::hypot(errors[14] / scale[0], errors[15] / 2), 1e-9);
}

TEST(GridStudy, RefusesWhatCannotBeRun) {
    const auto make = [](const calibration::GridOptions& options) {
        calibration::make_grid("grid", std::make_shared<AnalyticSimulator>(), options);
    };
    calibration::GridOptions options = made_options();
    options.budget = 359;
    EXPECT_THROW(make(options), std::invalid_argument);
    options = made_options();
    options.targets[0].measured = 0;
    EXPECT_THROW(make(options), std::invalid_argument);
    options = made_options();
    options.targets[0].output = "cold";
    EXPECT_THROW(make(options), std::invalid_argument);
    options = made_options();
    options.grids[0][0].first = "light";
    EXPECT_THROW(make(options), std::invalid_argument);
    options = made_options();
    options.grids[0][0].second = {3, 3};
    EXPECT_THROW(make(options), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::study
