/// Steps in made residuals: how often noise raises an alarm, held to the rate that was
/// asked for, and that a planted step is told with its day; the same behind a first step.
#include "base/nan.hpp"
#include "base/random.hpp"
#include "stats/distributions.hpp"
#include "stats/step_test.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr std::size_t n_known = 365, n_days = n_known + 42, n_features = 4;

/// Days that remember the day before, and a level that goes up and down in a year.
Matrix noise(std::uint64_t seed, double memory, double season,
             std::size_t n = n_features) {
    Stream random(seed, 0, 0);
    Matrix residuals(n_days, n);
    std::vector<double> last(n, 0);
    for (std::size_t d = 0; d < n_days; ++d)
        for (std::size_t f = 0; f < n; ++f) {
            last[f] = memory * last[f] +
                      std::sqrt(1 - memory * memory) * normal_quantile(random.uniform());
            residuals(d, f) =
                last[f] + season * std::sin(2 * std::numbers::pi *
                                            static_cast<double>(d + 40 * seed) / 365);
        }
    return residuals;
}

/// One of each feature, and one of all together.
std::vector<Matrix> patterns(std::size_t n = n_features) {
    std::vector<Matrix> all(n + 1, Matrix(n_days, n));
    for (std::size_t d = 0; d < n_days; ++d)
        for (std::size_t f = 0; f < n; ++f) all[f](d, f) = all[n](d, f) = 1;
    return all;
}

const Matrix ones(n_days, n_features, 1.0);

std::optional<Step> told(const Matrix& residuals, double false_alarms,
                         const std::vector<double>& wander = {}) {
    const std::size_t n = residuals.cols;
    const StepTest test(residuals, Matrix(n_days, n, 1.0), patterns(n),
                        {n_known, false_alarms, wander});
    std::optional<Step> best;
    for (std::size_t k = 0; k <= n; ++k) {
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

constexpr std::size_t first_told = n_known + 7;  ///< row of a step that was told

std::vector<Told> behind_it() {
    std::vector<Told> days(n_days, Told::nothing);
    std::fill(days.begin() + first_told, days.end(), Told::behind);
    days[first_told] = Told::first_day;
    return days;
}

// What a change leaves comes at once and wanders: so much in each feature, and as much
// again in a season of 91 days.
TEST(StepTest, RaisesNoMoreFalseAlarmsThanAskedBehindAStep) {
    constexpr int n_looks = 1000;
    constexpr double rate = 0.02, left = 4;
    const double most = n_looks * rate + 3 * std::sqrt(n_looks * rate);
    int n_false = 0, n_without = 0;
    for (int k = 0; k < n_looks; ++k) {
        const auto seed = static_cast<std::uint64_t>(k + 1);
        Matrix residuals = noise(seed, 0, 0.2);
        Stream random(seed, 1, 0);
        for (std::size_t f = 0; f < n_features; ++f) {
            double level = 0;
            for (std::size_t d = first_told; d < n_days; ++d) {
                level += std::sqrt(d == first_told ? left : left / 91) *
                         normal_quantile(random.uniform());
                residuals(d, f) += level;
            }
        }
        const auto wander = wander_behind(residuals, ones, behind_it());
        n_false += told(residuals, rate, wander) ? 1 : 0;
        n_without += told(residuals, rate) ? 1 : 0;
    }
    EXPECT_LE(n_false, most);
    EXPECT_GT(n_without, 10 * most);
}

/// Of 100 with four meters by quarters, of which one feature has taken a step that was
/// told and is taken away: how often a second is told with its day.
int n_second_told(std::size_t feature, double size) {
    constexpr std::size_t n_of_four = 16, day = n_days - 14;
    constexpr double first = 4;
    int n_told = 0;
    for (int k = 0; k < 100; ++k) {
        Matrix residuals = noise(static_cast<std::uint64_t>(1000 + k), 0, 0.1, n_of_four);
        for (std::size_t d = first_told; d < n_days; ++d) residuals(d, 2) += first;
        for (std::size_t d = day; d < n_days; ++d) residuals(d, feature) += size;
        const auto wander =
            wander_behind(residuals, Matrix(n_days, n_of_four, 1.0), behind_it());
        for (std::size_t d = first_told; d < n_days; ++d) residuals(d, 2) -= first;
        const auto step = told(residuals, 1e-3, wander);
        n_told += step && step->pattern == feature && step->day + 3 >= day &&
                  step->day <= day + 3;
    }
    return n_told;
}

// As large as the first.
TEST(StepTest, TellsThatAToldStepEndsAndThatAnotherBegins) {
    EXPECT_GE(n_second_told(2, -4), 85);
    EXPECT_GE(n_second_told(0, 4), 85);
}

TEST(StepTest, WanderIsWhatAStepLeavesBeyondKnownDays) {
    const auto wander_of = [](double each) {
        Matrix residuals(n_days, n_features, nan);
        for (std::size_t d = 0; d < n_days; ++d)
            for (std::size_t f = 1; f < n_features; ++f)
                residuals(d, f) = d < first_told ? 1 : each;
        return wander_behind(residuals, ones, behind_it());
    };
    const auto wander = wander_of(3);
    EXPECT_EQ(wander[first_told - 1], 0);
    EXPECT_NEAR(wander[first_told], 3 * 3 - 1, 1e-12);
    EXPECT_NEAR(wander[first_told + 1], (3 * 3 - 1) / 91.0, 1e-12);
    EXPECT_NEAR(wander_of(100)[first_told], 4 * 4 - 1, 1e-12);  // a day is held in
    EXPECT_EQ(wander_of(0.9)[first_told], 0);
}

// The filter of a coefficient that does not wander is the mean of the days before.
TEST(StepTest, WithoutWanderIsAsWithNone) {
    const Matrix residuals = noise(5, 0.4, 0.3);
    const StepTest none(residuals, ones, patterns(), {n_known, 1e-3}),
        zero(residuals, ones, patterns(),
             {n_known, 1e-3, std::vector<double>(n_days, 0)});
    for (std::size_t k = 0; k <= n_features; ++k)
        EXPECT_EQ(none.surest(k)->statistic, zero.surest(k)->statistic);
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
