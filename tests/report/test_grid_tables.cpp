#include "calibration/grid.hpp"
#include "calibration/optimisation.hpp"
#include "report/tables.hpp"
#include "study/analytic_simulator.hpp"

#include <regex>
#include <sstream>

#include <gtest/gtest.h>

namespace bemcal::report {
namespace {

using test::AnalyticSimulator;

/// As `run` does it, on one rank: round after round.
store::ResultFile result_of(const std::unique_ptr<study::Stage>& stage) {
    std::vector<study::ItemAnswer> answers;
    store::ResultFile result;
    for (int first = 0, n = stage->n_items();;) {
        for (int item = first; item < first + n; ++item)
            answers.push_back(stage->run(item));
        const auto next = stage->next_round(answers);
        if (!next) break;
        first += n;
        n = next->n_items;
        stage->begin_round(first, *next);
    }
    result.datasets = stage->conclude(answers).datasets;
    return result;
}

const std::vector<calibration::GridTarget> targets{{"power", 27.2, 0},
                                                   {"heat", 232.8, 0}};

calibration::GridOptions two_stages() {
    calibration::GridOptions options;
    options.grids = {{{"lights", {3, 4, 5, 6}},
                      {"devices", {4, 5, 6, 7, 8}},
                      {"air", {1, 3, 5}},
                      {"colour", {1, 2}}}};
    options.targets = targets;
    options.most_stages = 2;
    return options;
}

std::string grid_text(double fails_above = 1e9) {
    return tables_of(result_of(calibration::make_grid(
        "house/grid", std::make_shared<AnalyticSimulator>(fails_above), two_stages())));
}

bool has(const std::string& text, const std::string& pattern) {
    return std::regex_search(text, std::regex(pattern));
}

TEST(GridTables, SayThePointsAndTheNearestOfEachStage) {
    const std::string text = grid_text();
    EXPECT_TRUE(has(text, "house/grid: grid in stages")) << text;
    EXPECT_TRUE(has(text, "measured: power 27\\.2 kWh, heat 232\\.8 kWh")) << text;
    EXPECT_TRUE(has(text, "\n +1 +120 +[0-9.]+ +[-+][0-9.]+ +[-+][0-9.]+")) << text;
    EXPECT_TRUE(has(text, "\n +2 +[0-9]+ +[0-9.]+ +[-+][0-9.]+ +[-+][0-9.]+")) << text;
    EXPECT_TRUE(has(text, "points; all stages are done")) << text;
}

TEST(GridTables, TellWhatBecameOfEachParameter) {
    const std::string text = grid_text();
    EXPECT_TRUE(has(text, "\n +air +3 +1 .*determined at 3")) << text;
    EXPECT_TRUE(has(text, "\n +(lights|devices) .* open")) << text;
    EXPECT_TRUE(has(text, "parameter +nearest of all +unit")) << text;
}

TEST(GridTables, MarkThePlainlyNearestAmongTheSelected) {
    const std::string text = grid_text();
    const auto begin = text.find("stage 1: nearest with density avoidance");
    ASSERT_NE(begin, std::string::npos) << text;
    EXPECT_TRUE(has(text.substr(begin), "\n +\\* +[0-9.]+")) << text;
}

TEST(GridTables, CountFailedPointsAndAreNoWiderThanAHundredColumns) {
    const std::string text = grid_text(4);
    EXPECT_TRUE(has(text, "40 .*failed")) << text;  // a third of 120 had air 5
    EXPECT_TRUE(has(text, "x too much air")) << text;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U);
}

TEST(OptimisationTables, OfTargetsSayThemTheirErrorsAndTheBestPoint) {
    calibration::OptimisationOptions options;
    options.evaluations = 600;
    options.parameters = {"lights", "air"};
    const calibration::TargetAim aim{std::make_shared<AnalyticSimulator>(), targets, {}};
    const std::string text =
        tables_of(result_of(calibration::make_optimisation("house/best", aim, options)));
    EXPECT_TRUE(has(text, "house/best: best of 600 evaluations")) << text;
    EXPECT_TRUE(has(text, "\n +power +27\\.2 +kWh +[-+][0-9.]+")) << text;
    EXPECT_TRUE(has(text, "\n +lights +[0-9.]+ +-")) << text;
}

TEST(OptimisationTables, OfNsga2ShowTheFront) {
    calibration::OptimisationOptions options;
    options.method = calibration::OptimisationMethod::nsga2;
    options.n_population = 12;
    options.n_generations = 5;
    const calibration::TargetAim aim{std::make_shared<AnalyticSimulator>(), targets, {}};
    const std::string text =
        tables_of(result_of(calibration::make_optimisation("house/front", aim, options)));
    EXPECT_TRUE(has(text, "front of [0-9]+ points")) << text;
    EXPECT_TRUE(has(text, "power \\[%\\] +heat \\[%\\]")) << text;
}

}  // namespace
}  // namespace bemcal::report
