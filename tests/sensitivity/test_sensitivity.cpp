#include "sensitivity/sensitivity.hpp"
#include "sensitivity/simulators.hpp"
#include "stats/functions.hpp"
#include "stats/saltelli.hpp"
#include "study/find.hpp"
#include "study/small_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::find;

/// Ishigami's function and a constant, of angles in -pi..pi; fails where the first is
/// above 3.
class Angles : public Simulator {
  public:
    explicit Angles(bool fails = false) : fails_(fails) {
        for (const char* name : {"x1", "x2", "x3"}) {
            physics::Parameter parameter;
            parameter.name = name;
            parameter.least = -std::numbers::pi;
            parameter.most = std::numbers::pi;
            parameters_.push_back(parameter);
        }
    }
    const std::vector<physics::Parameter>& parameters() const override {
        return parameters_;
    }
    const std::vector<Output>& outputs() const override { return outputs_; }
    void evaluate(const Matrix& points, Matrix& answers,
                  std::vector<std::string>& failures) const override {
        answers = Matrix(points.rows, 2, std::numeric_limits<double>::quiet_NaN());
        failures.assign(points.rows, {});
        for (std::size_t r = 0; r < points.rows; ++r) {
            if (fails_ && points(r, 0) > 3) {
                failures[r] = "x1 is above 3";
                continue;
            }
            const double u[] = {points(r, 0) / (2 * std::numbers::pi) + 0.5,
                                points(r, 1) / (2 * std::numbers::pi) + 0.5,
                                points(r, 2) / (2 * std::numbers::pi) + 0.5};
            answers(r, 0) = test::ishigami(u);
            answers(r, 1) = 2;
        }
    }

  private:
    bool fails_;
    std::vector<physics::Parameter> parameters_;
    std::vector<Output> outputs_{{"ishigami", "-"}, {"two", "-"}};
};

std::vector<Dataset> run(const Stage& stage) {
    std::vector<ItemAnswer> answers;
    for (int item = 0; item < stage.n_items(); ++item) answers.push_back(stage.run(item));
    return stage.conclude(answers).datasets;
}

sensitivity::SensitivityOptions options_of(std::size_t n_base) {
    sensitivity::SensitivityOptions options;
    options.n_base = n_base;
    options.n_bootstrap = 100;
    options.seed = 8;
    return options;
}

// Closed form of Ishigami's function with a = 7, b = 0.1 (see
// stats/test_sobol_indices.cpp).
TEST(Sensitivity, GivesEveryOutputsIndices) {
    const auto stage = sensitivity::make_sensitivity(
        "angles/sensitivity", std::make_shared<Angles>(), options_of(4096));
    EXPECT_EQ(stage->n_items(), 64);
    EXPECT_EQ(stage->n_simulations(), 4096 * 5);
    const auto datasets = run(*stage);
    const auto& total = find(datasets, "total_order");
    EXPECT_EQ(total.path, "angles/sensitivity/total_order");
    EXPECT_EQ(total.shape, (std::vector<std::size_t>{2, 3}));
    EXPECT_NEAR(total.values[0], 0.5576, 0.01);
    EXPECT_NEAR(total.values[1], 0.4424, 0.01);
    EXPECT_NEAR(find(datasets, "first_order").values[2], 0, 0.01);
    EXPECT_TRUE(std::isnan(total.values[4]));  // a constant has no indices
    EXPECT_EQ(find(datasets, "sensitive").values,
              (std::vector<double>{1, 1, 1, 0, 0, 0}));
}

TEST(Sensitivity, FlagsWhatIsAboveTheThreshold) {
    sensitivity::SensitivityOptions options = options_of(1024);
    options.threshold = 0.35;
    const auto datasets =
        run(*sensitivity::make_sensitivity("s", std::make_shared<Angles>(), options));
    EXPECT_EQ(find(datasets, "sensitive").values,
              (std::vector<double>{1, 1, 0, 0, 0, 0}));
    EXPECT_EQ(find(datasets, "threshold").values, (std::vector<double>{0.35}));
}

TEST(Sensitivity, StoresOutputsFromWhichItsIndicesFollow) {
    const auto datasets = run(
        *sensitivity::make_sensitivity("s", std::make_shared<Angles>(), options_of(100)));
    const auto& outputs = find(datasets, "design_output");
    EXPECT_EQ(outputs.shape, (std::vector<std::size_t>{100, 5, 2}));
    std::vector<double> first_output;
    for (std::size_t r = 0; r < 500; ++r) first_output.push_back(outputs.values[2 * r]);
    const auto indices = stats::sobol_indices(first_output, 3, 100, 8);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(find(datasets, "total_order").values[i], indices.total_order[i]);
        EXPECT_EQ(find(datasets, "total_order_half_width").values[i],
                  indices.total_half_width[i]);
    }
}

TEST(Sensitivity, LeavesFailedBasePointsOutAndCountsTheFailures) {
    const auto datasets = run(*sensitivity::make_sensitivity(
        "s", std::make_shared<Angles>(true), options_of(1024)));
    const double n_failed = find(datasets, "n_failed").values[0];
    const double n_used = find(datasets, "n_used").values[0];
    // x1 is above 3 in 2.25 % of rows: in A (then in all rows but AB_1) or in B (AB_1 and
    // B).
    EXPECT_NEAR(n_failed, 1024 * 5 * 0.0225, 15);
    EXPECT_NEAR(n_used, 1024 * (1 - 0.0445), 15);
    EXPECT_EQ(find(datasets, "failed_point").values.size(), n_failed);
    EXPECT_EQ(find(datasets, "failed_reason").texts[0], "x1 is above 3");
}

TEST(Sensitivity, DropsAnItemThatFailedAsAWhole) {
    const auto stage =
        sensitivity::make_sensitivity("s", std::make_shared<Angles>(), options_of(256));
    std::vector<ItemAnswer> answers;
    for (int item = 0; item < 4; ++item) answers.push_back(stage->run(item));
    answers[2] = {{}, {}, "out of memory"};
    const auto datasets = stage->conclude(answers).datasets;
    EXPECT_EQ(find(datasets, "n_used").values[0], 192);
    EXPECT_EQ(find(datasets, "n_failed").values[0], 64 * 5);
}

// Heating over ten days of April: the set-point, air change and solar gains all act on
// it; more fresh air and a higher set-point need more.
TEST(BatchSimulator, AnswersWithTotalsOfThePeriod) {
    const Case made = test::small_case();
    const auto simulator = sensitivity::make_batch_simulator(
        made, made.periods[0], {physics::Quantity::heating, physics::Quantity::gas});
    EXPECT_EQ(simulator->outputs()[0].name, "heating");
    EXPECT_EQ(simulator->outputs()[1].unit, "kWh");
    Matrix points(3, 3), answers;
    points.values = {0.4, 0.5, 21, 1.2, 0.5, 21, 1.2, 0.5, 22};
    std::vector<std::string> failures;
    simulator->evaluate(points, answers, failures);
    EXPECT_LT(answers(0, 0), answers(1, 0));
    EXPECT_LT(answers(1, 0), answers(2, 0));
    EXPECT_NEAR(answers(0, 1), answers(0, 0) / 0.9, 1e-6);  // the plant's efficiency
    const auto datasets = run(
        *sensitivity::make_sensitivity("small/sensitivity", simulator, options_of(256)));
    for (const double index : find(datasets, "total_order").values) EXPECT_GT(index, 0);
}

TEST(OfficeHourSimulator, FixesInputsByName) {
    const auto simulator =
        sensitivity::make_office_hour_simulator({{"GFA", 50000}, {"theta_prev", 20}});
    EXPECT_EQ(simulator->parameters().size(), 17U);
    EXPECT_EQ(simulator->parameters()[0].name, "L");
    EXPECT_THROW(sensitivity::make_office_hour_simulator({{"gfa", 1}}),
                 std::invalid_argument);
}

TEST(OfficeHourSimulator, GivesTheReasonOfAnImpossibleBox) {
    const auto simulator = sensitivity::make_office_hour_simulator({{"GFA", 300}});
    Matrix points(1, 18), answers;
    for (std::size_t k = 0; k < 18; ++k)
        points(0, k) = simulator->parameters()[k].nominal;
    std::vector<std::string> failures;
    simulator->evaluate(points, answers, failures);
    EXPECT_NE(failures[0], "");
}

/// Names of the inputs with the two largest total-order indices.
std::vector<std::string> two_largest(const std::vector<Dataset>& datasets) {
    const auto& total = find(datasets, "total_order").values;
    const auto& names = find(datasets, "parameter").texts;
    std::vector<std::size_t> order(total.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::ranges::sort(order,
                      [&](std::size_t a, std::size_t b) { return total[a] > total[b]; });
    std::vector<std::string> largest{names[order[0]], names[order[1]]};
    std::ranges::sort(largest);
    return largest;
}

// Paper 1, section 3.1: "variable 1 (GFA) and variable 14 (theta_t-1) are too large".
TEST(OfficeHourSensitivity, HasFloorAreaAndLastTemperatureAsItsLargest) {
    const auto datasets = run(*sensitivity::make_sensitivity(
        "paper1/sensitivity", sensitivity::make_office_hour_simulator({}),
        options_of(4096)));
    EXPECT_EQ(two_largest(datasets), (std::vector<std::string>{"GFA", "theta_prev"}));
    EXPECT_EQ(find(datasets, "n_failed").values[0], 0);
}

}  // namespace
}  // namespace bemcal::study
