#include "checks/data_steps.hpp"
#include "checks/made_meters.hpp"

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr int day = 24;

void scale_from(MadeMeter& meter, int from, double factor) {
    for (std::size_t k = static_cast<std::size_t>(from); k < meter.values.size(); ++k)
        meter.values[k] *= factor;
}

/// Heat with hot water, so that it is never 0.
MadeMeter heat_with_water(std::uint64_t seed, int n_days) {
    MadeMeter meter = made_heat(seed, n_days);
    Stream stream(seed, 7, 7);
    for (double& value : meter.values) value += 8 + 2 * stream.uniform();
    return meter;
}

TEST(ScaleSteps, OfElectricityAreFoundToTheHour) {
    for (const double factor : {10.0, 0.001, 3.6, 0.25}) {
        MadeMeter meter = made_electricity(3, 365);
        scale_from(meter, 150 * day + 9, factor);
        const auto steps = checks::scale_steps(meter.series());
        ASSERT_EQ(steps.size(), 1U) << factor;
        EXPECT_NEAR(steps[0].at, 150 * day + 9, 2) << factor;
        EXPECT_NEAR(std::log(steps[0].ratio / factor), 0, 0.1) << factor;
        EXPECT_EQ(steps[0].proof, checks::Proof::quantum) << factor;
    }
}

TEST(ScaleSteps, OfHeatAreProvenByTheYearsAround) {
    MadeMeter meter = heat_with_water(5, 1000);
    scale_from(meter, 430 * day, 11.2);
    const auto steps = checks::scale_steps(meter.series());
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_NEAR(steps[0].at, 430 * day, 12);
    EXPECT_NE(steps[0].proof, checks::Proof::none);
}

TEST(ScaleSteps, TwoOfThemAreFound) {
    MadeMeter meter = made_electricity(6, 365);
    scale_from(meter, 100 * day, 10);
    scale_from(meter, 250 * day, 0.1);
    EXPECT_EQ(checks::scale_steps(meter.series()).size(), 2U);
}

TEST(ScaleSteps, WhatGoesAfterThreeWeeksOrChangesSomeHoursOnlyIsNone) {
    MadeMeter meter = made_electricity(7, 365);
    for (int k = 100 * day; k < 121 * day; ++k)
        meter.values[static_cast<std::size_t>(k)] *= 5;
    EXPECT_TRUE(checks::scale_steps(meter.series()).empty());
    meter = made_electricity(7, 365);
    for (int k = 100 * day; k < 365 * day; ++k)
        if (k % 24 > 7 && k % 24 < 19) meter.values[static_cast<std::size_t>(k)] *= 5;
    EXPECT_TRUE(checks::scale_steps(meter.series()).empty());
}

// A factor that a building may well have itself is for the search of effects.
TEST(ScaleSteps, AQuarterMoreIsNone) {
    for (const double factor : {0.7, 1.25, 1.4}) {
        MadeMeter meter = made_electricity(8, 365);
        scale_from(meter, 150 * day, factor);
        EXPECT_TRUE(checks::scale_steps(meter.series()).empty()) << factor;
    }
}

// 200 clean meters of a year and a half: none may have a step, seasons that begin on a
// date included. With no false alarm the rate is below 1.5 % of meters (95 %).
TEST(CleanMeters, HaveNoSteps) {
    for (std::uint64_t seed = 0; seed < 200; ++seed)
        EXPECT_TRUE(checks::scale_steps(made_meter(seed).series()).empty()) << seed;
}

}  // namespace
}  // namespace bemcal::stats
