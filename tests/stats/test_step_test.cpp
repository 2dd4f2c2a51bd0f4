/// Steps in made residuals: how often noise raises an alarm, held to the rate that was
/// asked for, and that a planted step is told with its day.
#include "base/nan.hpp"
#include "base/random.hpp"
#include "stats/distributions.hpp"
#include "stats/step_test.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr std::size_t n_known = 365, n_days = n_known + 42, n_features = 4;

/// Days that remember the day before, and a level that goes up and down in a year.
Matrix noise(std::uint64_t seed, double memory, double season) {
    Stream random(seed, 0, 0);
    Matrix residuals(n_days, n_features);
    std::vector<double> last(n_features, 0);
    for (std::size_t d = 0; d < n_days; ++d)
        for (std::size_t f = 0; f < n_features; ++f) {
            last[f] = memory * last[f] +
                      std::sqrt(1 - memory * memory) * normal_quantile(random.uniform());
            residuals(d, f) =
                last[f] + season * std::sin(2 * std::numbers::pi *
                                            static_cast<double>(d + 40 * seed) / 365);
        }
    return residuals;
}

/// One of each feature, and one of all together.
std::vector<Matrix> patterns() {
    std::vector<Matrix> all(n_features + 1, Matrix(n_days, n_features));
    for (std::size_t d = 0; d < n_days; ++d)
        for (std::size_t f = 0; f < n_features; ++f)
            all[f](d, f) = all[n_features](d, f) = 1;
    return all;
}

const Matrix ones(n_days, n_features, 1.0);

std::optional<Step> told(const Matrix& residuals, double false_alarms) {
    const StepTest test(residuals, ones, patterns(), {n_known, false_alarms});
    std::optional<Step> best;
    for (std::size_t k = 0; k <= n_features; ++k) {
        const auto step = test.surest(k);
        if (step && test.is_told(*step) &&
            (!best || std::abs(step->statistic) > std::abs(best->statistic)))
            best = step;
    }
    return best;
}

TEST(StepTest, RaisesNoMoreFalseAlarmsThanAsked) {
    constexpr int n_looks = 2000;
    constexpr double rate = 0.02;
    // Three standard deviations of their number above what was asked.
    const double most = n_looks * rate + 3 * std::sqrt(n_looks * rate);
    for (const double memory : {0.0, 0.4}) {
        int n_false = 0;
        for (int k = 0; k < n_looks; ++k)
            n_false +=
                told(noise(static_cast<std::uint64_t>(k + 1), memory, 0.2), rate) ? 1 : 0;
        EXPECT_LE(n_false, most) << memory;
    }
}

TEST(StepTest, TellsAStepWithItsDay) {
    int n_told = 0, n_near = 0;
    constexpr int n_steps = 100;
    for (int k = 0; k < n_steps; ++k) {
        Matrix residuals = noise(static_cast<std::uint64_t>(1000 + k), 0, 0.1);
        const std::size_t day = n_days - 17;
        for (std::size_t d = day; d < n_days; ++d) residuals(d, 2) += 2;  // 2 sqrt(17)
        const auto step = told(residuals, 1e-3);
        if (!step) continue;
        n_told += 1;
        EXPECT_EQ(step->pattern, 2U);
        EXPECT_NEAR(step->size, 2, 1.5);
        n_near += step->day + 3 >= day && step->day <= day + 3 ? 1 : 0;
    }
    EXPECT_GE(n_told, 85);
    EXPECT_GE(n_near, n_told * 3 / 4);
}

TEST(StepTest, TellsJustAboveItsThresholdAndNotJustBelow) {
    // Nothing in eight weeks, then a week at a share of the threshold.
    const auto is_told = [](double share) {
        Matrix residuals = noise(7, 0, 0);
        for (std::size_t d = n_days - 56; d < n_days; ++d) residuals(d, 0) = 0;
        const StepOptions options{n_known, 1e-3};
        const StepTest before(residuals, ones, {patterns()[0]}, options);
        const double size = share * before.threshold() * before.surest(0)->sd;
        for (std::size_t d = n_days - 7; d < n_days; ++d) residuals(d, 0) = size;
        const StepTest test(residuals, ones, {patterns()[0]}, options);
        return test.is_told(*test.surest(0));
    };
    EXPECT_TRUE(is_told(1.01));
    EXPECT_FALSE(is_told(0.99));
}

// A model leaves a tenth more of new days than of those that it has learned from.
TEST(StepTest, NewDaysAreLessSureThanKnownOnes) {
    Matrix residuals = noise(7, 0, 0);
    for (std::size_t d = n_days - 7; d < n_days; ++d) residuals(d, 0) = 2;
    const auto step =
        StepTest(residuals, ones, {patterns()[0]}, {n_known, 1e-3}).surest(0);
    ASSERT_TRUE(step);
    const double as_known = std::sqrt(1.0 / static_cast<double>(n_days - step->day));
    EXPECT_GE(step->sd, 1.1 * as_known);
    EXPECT_LE(step->sd, 1.3 * as_known);
}

TEST(StepTest, SaysNothingOfAPatternWithoutASayOrOfMissingDays) {
    Matrix residuals = noise(3, 0, 0);
    auto all = patterns();
    for (std::size_t d = n_days - 40; d < n_days; ++d) all[0](d, 0) = 0;
    for (std::size_t d = n_known; d < n_days; ++d) residuals(d, 1) = nan;
    const StepTest test(residuals, ones, all, {n_known, 1e-3});
    EXPECT_FALSE(test.surest(0));
    EXPECT_FALSE(test.surest(1));
    EXPECT_TRUE(test.surest(2));
}

TEST(StepTest, SpreadFollowsWhatIsPredicted) {
    Matrix residuals(200, 1), predicted(200, 1);
    for (std::size_t d = 0; d < 200; ++d) {
        predicted(d, 0) = d < 100 ? 1 : 10;
        residuals(d, 0) = (d % 2 == 0 ? 1 : -1) * (d < 100 ? 1 : 3);
    }
    const Matrix spread = spread_of(residuals, predicted, 200);
    EXPECT_NEAR(spread(10, 0), 1, 1e-12);
    EXPECT_NEAR(spread(150, 0), 3, 1e-12);
}

// What the known days have never shown may all be wrong.
TEST(StepTest, SpreadHoldsAllThatIsPredictedBeyondTheKnownDays) {
    Matrix residuals(202, 1), predicted(202, 1);
    for (std::size_t d = 0; d < 202; ++d) {
        predicted(d, 0) = 5 + 0.05 * static_cast<double>(d % 101);
        residuals(d, 0) = 1;
    }
    predicted(200, 0) = 14;
    predicted(201, 0) = 2;
    const Matrix spread = spread_of(residuals, predicted, 200);
    EXPECT_NEAR(spread(150, 0), 1, 0.05);
    EXPECT_NEAR(spread(200, 0), 14 / 9.5 + 4.1, 0.1);
    EXPECT_NEAR(spread(201, 0), 1 + 3.1, 0.05);
}

}  // namespace
}  // namespace bemcal::stats
