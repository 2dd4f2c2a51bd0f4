#include "checks/data_runs.hpp"
#include "checks/made_meters.hpp"

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr int day = 24;

void fill(MadeMeter& meter, int first, int n, double value) {
    std::fill_n(meter.values.begin() + first, n, value);
}

TEST(ConstantRuns, OfZerosAndOfOtherValuesAreFoundApart) {
    const std::vector<double> readings{1, 0, 0, 0, 2, 2, 2, 2, std::nan(""), 0, 0};
    const auto zeros = checks::constant_runs(readings, 3, true);
    ASSERT_EQ(zeros.size(), 1U);
    EXPECT_EQ(zeros[0].first, 1);
    EXPECT_EQ(zeros[0].n, 3);
    const auto same = checks::constant_runs(readings, 3, false);
    ASSERT_EQ(same.size(), 1U);
    EXPECT_EQ(same[0].first, 4);
    EXPECT_EQ(same[0].value, 2);
}

TEST(Quantum, IsTheSmallestDifferenceAndIgnoresBinaryRounding) {
    EXPECT_NEAR(checks::quantum_of(std::vector<double>{0.1 + 0.2, 0.3, 0.7, 0.5, 0.5}),
                0.2, 1e-12);
    EXPECT_EQ(checks::quantum_of(std::vector<double>{4, 4, std::nan("")}), 0);
}

TEST(ConstantFills, AreFoundAtTheirReadings) {
    MadeMeter meter = made_electricity(5, 365);  // rounded to 0.1
    const double value = meter.values[100 * day + 5] + 100;
    fill(meter, 100 * day + 5, 24, value);
    fill(meter, 200 * day, 14, value + 3);
    const auto fills = checks::constant_fills(meter.series());
    ASSERT_EQ(fills.size(), 2U);
    EXPECT_EQ(fills[0].first, 100 * day + 5);
    EXPECT_EQ(fills[0].n, 24);
    EXPECT_EQ(fills[1].first, 200 * day);
}

TEST(ConstantFills, OfATemperatureNeedADay) {
    MadeMeter meter = made_temperature(1, 365);
    fill(meter, 50 * day, 20, 25.3);
    EXPECT_TRUE(checks::constant_fills(meter.series()).empty());
    fill(meter, 50 * day, 30, 25.3);
    EXPECT_EQ(checks::constant_fills(meter.series()).size(), 1U);
}

// A school's base load of two counts of its meter stands still for weeks.
TEST(ConstantFills, AValueOfFewQuantaMayStandStill) {
    MadeMeter meter = made_electricity(1, 365);
    for (double& value : meter.values) value = std::round(value);
    fill(meter, 200 * day, 40 * day, 2);
    EXPECT_TRUE(checks::constant_fills(meter.series()).empty());
}

TEST(MissingZeros, InABaseLoadAreMissingWhateverTheirLength) {
    MadeMeter meter = made_electricity(2, 365);
    fill(meter, 30 * day + 3, 1, 0);
    fill(meter, 100 * day, 23, 0);
    fill(meter, 200 * day, 40 * day, 0);
    EXPECT_EQ(checks::missing_zeros(meter.series()).size(), 3U);
}

TEST(MissingZeros, AtTheBeginOfABaseLoadAreMissingToo) {
    MadeMeter meter = made_electricity(2, 365);
    fill(meter, 0, 50 * day, 0);
    ASSERT_EQ(checks::missing_zeros(meter.series()).size(), 1U);
}

MadeMeter winter_heat() {
    MadeMeter meter = made_heat(1, 365);
    Stream stream(9, 9, 9);
    for (int k = 0; k < 60 * day; ++k)
        meter.values[static_cast<std::size_t>(k)] = 50 + 10 * stream.uniform();
    return meter;
}

TEST(MissingZeros, OfADayInADeepWinterAreMissing) {
    MadeMeter meter = winter_heat();
    fill(meter, 30 * day, 24, 0);
    const auto runs = checks::missing_zeros(meter.series());
    ASSERT_EQ(runs.size(), 1U);
    EXPECT_EQ(runs[0].first, 30 * day);
}

TEST(MissingZeros, OfAMildNightOrOfThreeWeeksAreHeatingThatIsOff) {
    MadeMeter meter = winter_heat();
    fill(meter, 30 * day, 8, 0);
    EXPECT_TRUE(checks::missing_zeros(meter.series()).empty());
    fill(meter, 30 * day, 21 * day, 0);
    EXPECT_TRUE(checks::missing_zeros(meter.series()).empty());
}

// 200 clean meters of a year and a half: none may have a run masked. With no false alarm
// the rate is below 1.5 % of meters (95 %).
TEST(CleanMeters, HaveNoFillsAndNoMissingZeros) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const MadeMeter meter = made_meter(seed);
        EXPECT_TRUE(checks::constant_fills(meter.series()).empty()) << seed;
        EXPECT_TRUE(checks::missing_zeros(meter.series()).empty()) << seed;
    }
}

TEST(ConstantFills, OfACoarseMeterAreEstimatesOnlyIfTheyLastAMonth) {
    const auto fills = [](double value, int n_days) {
        std::vector<double> values;
        for (int k = 0; k < 24 * 200; ++k) values.push_back(5 + k * 37 % 31);
        std::fill_n(values.begin() + 2400, 24 * n_days, value);
        return checks::constant_fills({values, 24, 0, 0, checks::Driver::people}).size();
    };
    EXPECT_EQ(fills(10, 27), 1U);
    EXPECT_EQ(fills(10, 26), 0U);
    EXPECT_EQ(fills(9, 27), 0U);
    EXPECT_EQ(fills(50, 26), 1U);
}

}  // namespace
}  // namespace bemcal::stats
