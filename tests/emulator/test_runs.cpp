/// Standardisation, what it refuses, and which runs are a grid.
#include "emulator/grid.hpp"
#include "emulator/small_study.hpp"

#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace bemcal::emulator::test {
namespace {

std::string refusal(const std::function<void(Observations&)>& damage) {
    Observations o = small_study({}, 1);
    damage(o);
    try {
        standardise(o);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

TEST(KohRuns, OutputsHaveMeanZeroAndSdOneInputsReachFromZeroToOne) {
    const Observations o = small_study({}, 1);
    const Standardised made = standardise(o);
    const std::vector<double>& y = made.data.simulated;
    const double mean = std::accumulate(y.begin(), y.end(), 0.0) / 30;
    double squares = 0;
    for (const double value : y) squares += value * value;
    EXPECT_NEAR(mean, 0, 1e-13);
    EXPECT_NEAR(squares / 29, 1, 1e-13);
    double least = 2, most = -1;
    for (std::size_t i = 0; i < 30; ++i) {
        least = std::min(least, made.data.simulated_t(i, 1));
        most = std::max(most, made.data.simulated_t(i, 1));
    }
    EXPECT_EQ(least, 0);
    EXPECT_EQ(most, 1);
    EXPECT_NEAR(made.output.physical(made.data.measured[2]), o.measured[2], 1e-10);
    EXPECT_NEAR(made.x[1].physical(made.data.measured_x(4, 1)), o.measured_x(4, 1),
                1e-12);
}

TEST(KohRuns, XReachesOverMeasurementsAndRunsTogether) {
    Observations o = small_study({}, 1);
    o.measured_x(0, 0) = 100;
    EXPECT_EQ(standardise(o).data.measured_x(0, 0), 1);
}

TEST(KohRuns, WhatCannotBeCalibratedIsRefusedWithItsPlace) {
    EXPECT_EQ(refusal([](Observations&) {}), "accepted");
    EXPECT_EQ(refusal([](Observations& o) { o.simulated[7] = o.simulated[6] = NAN; }),
              "simulated outputs: row 7, column 1 is nan: expected a finite number");
    EXPECT_EQ(refusal([](Observations& o) { o.measured.pop_back(); }),
              "5 measurements, but 6 rows of their inputs");
    EXPECT_EQ(refusal([](Observations& o) {
                  for (std::size_t i = 0; i < 30; ++i) o.simulated_t(i, 1) = 4;
              }),
              "input t2 is 4 everywhere: leave it out");
    EXPECT_EQ(refusal([](Observations& o) {
                  std::fill(o.simulated.begin(), o.simulated.end(), 3);
              }),
              "all simulated outputs are the same: nothing to calibrate by");
    const auto repeat = [](Observations& o) {
        for (std::size_t k = 0; k < 2; ++k) {
            o.simulated_x(9, k) = o.simulated_x(2, k);
            o.simulated_t(9, k) = o.simulated_t(2, k);
        }
        o.simulated[2] = 100;
        o.simulated[9] = 101;
    };
    EXPECT_EQ(
        refusal(repeat),
        "simulator runs 3 and 10 are at the same point, with different answers (100 "
        "and 101): leave one out");
}

TEST(KohRuns, AGridIsFoundInAnyOrderOfRuns) {
    Observations o = standardise(small_study({4, 5, 7}, 3)).data;
    const std::optional<Grid> before = find_grid(o);
    ASSERT_TRUE(before);
    EXPECT_EQ(before->t.rows, 4U);
    EXPECT_EQ(before->x.rows, 5U);
    EXPECT_EQ(before->of_measured, (std::vector<std::size_t>{0, 1, 2, 3, 4, 0, 1}));
    for (std::size_t i = 0, j = 13; i < j; i += 3, --j) {
        std::swap(o.simulated[i], o.simulated[j]);
        for (std::size_t k = 0; k < 2; ++k) {
            std::swap(o.simulated_x(i, k), o.simulated_x(j, k));
            std::swap(o.simulated_t(i, k), o.simulated_t(j, k));
        }
    }
    const std::optional<Grid> after = find_grid(o);
    ASSERT_TRUE(after);
    double sum_before = 0, sum_after = 0;  // each output with its own point
    for (std::size_t d = 0; d < 4; ++d)
        for (std::size_t i = 0; i < 5; ++i) {
            sum_before += before->output(d, i) * before->t(d, 0) * before->x(i, 1);
            sum_after += after->output(d, i) * after->t(d, 0) * after->x(i, 1);
        }
    EXPECT_NEAR(sum_before, sum_after, 1e-12);
}

TEST(KohRuns, AGridMayBeOffByItsToleranceAndNoMore) {
    Observations o = standardise(small_study({}, 3)).data;
    o.simulated_x(8, 0) += 3.6e-10;
    o.measured_x(2, 1) -= 3.6e-10;
    EXPECT_TRUE(find_grid(o));
    o.measured_x(2, 1) += 1e-6;
    EXPECT_FALSE(find_grid(o)) << "a measurement beside the grid";
    o = standardise(small_study({}, 3)).data;
    o.simulated_x(8, 0) += 1e-6;
    EXPECT_FALSE(find_grid(o)) << "a run beside the grid";
}

}  // namespace
}  // namespace bemcal::emulator::test
