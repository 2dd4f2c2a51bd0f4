#include "job/data_checks.hpp"
#include "job/units.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

/// A heated building's meter: a winter load over a base load, by hour, with noise.
std::vector<double> heat_meter(int n_days, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 0.15);
    std::vector<double> readings;
    for (int k = 0; k < 24 * n_days; ++k) {
        const double season = 1 + 0.8 * std::cos(2 * M_PI * k / 24 / 365);
        const double day = 1 + 0.4 * std::cos(2 * M_PI * (k % 24 - 8) / 24);
        readings.push_back(std::max(0.0, 20 * season * day * (1 + noise(random))));
    }
    return readings;
}

TEST(ConstantRuns, OfZerosAndOfOtherValuesAreFoundApart) {
    const std::vector<double> readings{1, 0, 0, 0, 2, 2, 2, 2, std::nan(""), 0, 0};
    const auto zeros = constant_runs(readings, 3, true);
    ASSERT_EQ(zeros.size(), 1U);
    EXPECT_EQ(zeros[0].first, 1);
    EXPECT_EQ(zeros[0].n, 3);
    const auto same = constant_runs(readings, 3, false);
    ASSERT_EQ(same.size(), 1U);
    EXPECT_EQ(same[0].first, 4);
    EXPECT_EQ(same[0].value, 2);
}

TEST(UnitSteps, CubicMetresThatBecomeKilowattHoursAreFoundWithinADay) {
    std::vector<double> readings = heat_meter(365, 1);
    for (std::size_t k = 0; k < 24 * 100; ++k) readings[k] /= 11.2;
    const auto steps = unit_steps(readings, 24);
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_EQ(steps[0].unit_ratio, 11.2);
    EXPECT_NEAR(steps[0].at / 24, 100, 1);
}

TEST(UnitSteps, AStepDownIsFoundToo) {
    std::vector<double> readings = heat_meter(365, 2);
    for (std::size_t k = 24 * 200; k < readings.size(); ++k) readings[k] /= 31.7;
    const auto steps = unit_steps(readings, 24);
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_NEAR(1 / steps[0].ratio, 31.7, 4);
}

// Twenty meters without a step: a false alarm in one of them is a defect of the rule.
TEST(UnitSteps, SeasonsAndNoiseAreNoSteps) {
    for (unsigned seed = 0; seed < 20; ++seed)
        EXPECT_TRUE(unit_steps(heat_meter(730, seed), 24).empty()) << seed;
}

TEST(Units, CubicMetresAndHundredsOfCubicFeetOfGasAreTheKnownFactors) {
    EXPECT_NEAR(find_unit("m3")->factor, 11.2, 0.05);
    EXPECT_NEAR(find_unit("100 ft3")->factor, 31.7, 0.1);
    EXPECT_NEAR(find_unit("therm")->factor, 29.3071, 1e-4);  // 100,000 Btu
    EXPECT_NEAR(77 * find_unit("degF")->factor + find_unit("degF")->offset, 25, 1e-12);
    EXPECT_EQ(find_unit("kwh"), nullptr);
}

}  // namespace
}  // namespace bemcal::job
