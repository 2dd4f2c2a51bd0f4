#include "physics/meters.hpp"
#include "sensitivity/sensitivity.hpp"
#include "stats/saltelli.hpp"
#include "study/find.hpp"
#include "study/points.hpp"
#include "study/small_case.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::find;
using test::small_case;

std::vector<ItemAnswer> run_all(const Stage& stage) {
    std::vector<ItemAnswer> answers;
    for (int item = 0; item < stage.n_items(); ++item) answers.push_back(stage.run(item));
    return answers;
}

sensitivity::SensitivityOptions options_of(std::size_t n_base) {
    sensitivity::SensitivityOptions options;
    options.n_base = n_base;
    options.seed = 3;
    return options;
}

/// Outputs of every row of the design and every step, by the plain simulation [rows x
/// steps].
Matrix plain_outputs(const Case& made, const Matrix& design, physics::Quantity quantity) {
    const physics::Drive drive = drive_of(made, made.periods[0]);
    Matrix outputs(design.rows,
                   static_cast<std::size_t>(axis_of(made, made.periods[0]).n_steps));
    physics::Building building = made.building;
    for (std::size_t r = 0; r < design.rows; ++r) {
        physics::apply(made.building, made.parameters, design.row(r), building);
        const auto energy = physics::predict(
            building, drive, physics::simulate(building, drive), quantity);
        std::ranges::copy(energy, outputs.row(r).begin());
    }
    return outputs;
}

void expect_equal_to_plain(physics::Quantity quantity, std::size_t n_base) {
    const Case made = small_case();
    const auto stage = sensitivity::make_hourly_sensitivity(
        "small/hourly", made, made.periods[0], quantity, options_of(n_base));
    const auto datasets = stage->conclude(run_all(*stage)).datasets;
    const auto &first = find(datasets, "hourly_first_order").values,
               &total = find(datasets, "hourly_total_order").values;
    const Matrix outputs = plain_outputs(
        made, in_ranges(stats::saltelli_points(0, n_base, 3, true, 3), made.parameters),
        quantity);
    int n_compared = 0;
    for (std::size_t step = 0; step < outputs.cols; ++step) {
        std::vector<double> column(outputs.rows);
        for (std::size_t r = 0; r < outputs.rows; ++r) column[r] = outputs(r, step);
        const auto expected = stats::sobol_indices(column, 3, 0, 0);
        for (std::size_t i = 0; i < 3; ++i) {
            if (expected.degenerate) {
                ASSERT_TRUE(std::isnan(total[3 * step + i])) << step;
                continue;
            }
            ++n_compared;
            ASSERT_NEAR(first[3 * step + i], expected.first_order[i], 1e-7) << step;
            ASSERT_NEAR(total[3 * step + i], expected.total_order[i], 1e-7) << step;
        }
    }
    EXPECT_GT(n_compared, 100);
}

TEST(HourlySensitivity, EqualsPlainIndicesOfEveryStep) {
    expect_equal_to_plain(physics::Quantity::heating, 128);
    expect_equal_to_plain(physics::Quantity::air_temperature, 128);
}

// 100 base points leave blocks of 3 and 4, and unused lanes in every company.
TEST(HourlySensitivity, EqualsPlainIndicesForAnyNumberOfBasePoints) {
    expect_equal_to_plain(physics::Quantity::gas, 100);
}

TEST(HourlySensitivity, LeavesFailedBasePointsOutAndCountsThem) {
    Case made = small_case();
    made.parameters.push_back(
        test::parameter(made.building, "zone.office.mass_area_ratio", 0.01, 2.5, 2.5));
    const auto stage =
        sensitivity::make_hourly_sensitivity("small/hourly", made, made.periods[0],
                                             physics::Quantity::heating, options_of(256));
    const auto answers = run_all(*stage);
    const auto datasets = stage->conclude(answers).datasets;
    const double n_failed = find(datasets, "n_failed").values[0];
    double n_used = 0;
    for (const double n : find(datasets, "block_n_used").values) n_used += n;
    EXPECT_GT(n_failed, 0);
    EXPECT_LT(n_used, 256);
    EXPECT_GT(n_used, 200);
    for (const double index : find(datasets, "series_total_order").values)
        EXPECT_TRUE(index > 0 && index < 2) << index;
}

// The set-point acts on heating through most of the day; its jackknife interval must hold
// the index of 16 times as many points. (95 % intervals of 720 steps are not independent:
// at least 80 % of them are asked for; the seed is fixed.)
TEST(HourlySensitivity, HasIntervalsThatHoldTheIndicesOfALargerDesign) {
    const Case made = small_case();
    const auto of = [&](std::size_t n) {
        const auto stage = sensitivity::make_hourly_sensitivity(
            "small/hourly", made, made.periods[0], physics::Quantity::air_temperature,
            options_of(n));
        return stage->conclude(run_all(*stage)).datasets;
    };
    const auto small = of(128), large = of(2048);
    const auto &index = find(small, "hourly_total_order").values,
               &half = find(small, "hourly_total_order_half_width").values,
               &truth = find(large, "hourly_total_order").values;
    int n = 0, n_inside = 0;
    for (std::size_t k = 0; k < index.size(); ++k) {
        if (std::isnan(index[k]) || std::isnan(truth[k])) continue;
        ++n;
        n_inside += std::abs(index[k] - truth[k]) <= half[k] + 1e-12;
    }
    EXPECT_GT(n, 600);
    EXPECT_GT(n_inside, 0.8 * n) << n_inside << " of " << n;
}

TEST(HourlySensitivity, IsTheSameForEveryInstructionSet) {
    const Case made = small_case();
    std::vector<double> first;
    for (const auto set : {kernel::InstructionSet::scalar, kernel::InstructionSet::v3,
                           kernel::InstructionSet::v4}) {
        if (!kernel::is_supported(set)) continue;
        ASSERT_EQ(setenv("BEMCAL_KERNEL", kernel::name_of(set), 1), 0);
        const auto stage = sensitivity::make_hourly_sensitivity(
            "small/hourly", made, made.periods[0], physics::Quantity::heating,
            options_of(100));
        const auto values = stage->run(5).values;
        if (first.empty()) first = values;
        EXPECT_EQ(values, first) << kernel::name_of(set);
    }
    unsetenv("BEMCAL_KERNEL");
}

TEST(HourlySensitivity, NeedsBlocksOfTwoBasePoints) {
    const Case made = small_case();
    EXPECT_THROW(
        sensitivity::make_hourly_sensitivity("x", made, made.periods[0],
                                             physics::Quantity::heating, options_of(32)),
        std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::study
