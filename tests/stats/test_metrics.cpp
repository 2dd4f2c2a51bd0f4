#include "stats/metrics.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// By hand: errors 1, -2, 2, 1; measured mean 5.
TEST(FitMetrics, AreThoseComputedByHand) {
    const std::vector<double> measured{2, 8, 4, 6}, simulated{3, 6, 6, 7};
    const FitMetrics m = metrics_of(simulated, measured);
    EXPECT_EQ(m.n, 4);
    EXPECT_DOUBLE_EQ(m.nmbe, 2.0 / 20);
    EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(10.0 / 4));
    EXPECT_DOUBLE_EQ(m.cv_rmse, std::sqrt(10.0 / 4) / 5);
    EXPECT_DOUBLE_EQ(m.cv_rmse_n1, std::sqrt(10.0 / 3) / 5);
    EXPECT_DOUBLE_EQ(m.mape, (1.0 / 2 + 2.0 / 8 + 2.0 / 4 + 1.0 / 6) / 4);
    EXPECT_DOUBLE_EQ(m.r2, 100.0 / (20 * 9));  // centred: cov 10, variances 9 and 20
}

TEST(FitMetrics, LeaveOutPairsWithNan) {
    const std::vector<double> measured{2, nan, 4, 6}, simulated{3, 6, nan, 7};
    EXPECT_EQ(metrics_of(simulated, measured).n, 2);
    EXPECT_DOUBLE_EQ(metrics_of(simulated, measured).nmbe, 2.0 / 8);
}

TEST(FitMetrics, TakeMapeOverNonZeroReadingsAndCountTheOthers) {
    const std::vector<double> measured{0, 2, 0, 4}, simulated{1, 3, 0, 4};
    const FitMetrics m = metrics_of(simulated, measured);
    EXPECT_EQ(m.n_left_out, 2);
    EXPECT_DOUBLE_EQ(m.mape, 0.25);
}

TEST(FitMetrics, AreUnknownWithoutPairsOrWithoutAMean) {
    const FitMetrics nothing = metrics_of(PairSums{});
    EXPECT_TRUE(std::isnan(nothing.cv_rmse));
    EXPECT_TRUE(std::isnan(nothing.mape));
    const std::vector<double> zeros{0, 0}, simulated{1, 2};
    EXPECT_TRUE(std::isnan(metrics_of(simulated, zeros).nmbe));
    EXPECT_TRUE(std::isnan(metrics_of(simulated, zeros).r2));
}

TEST(FitMetrics, OfReadingsWhoseMeanIsNotAboveZeroHaveNoCvRmse) {
    const std::vector<double> feeding_in{-3, 1}, simulated{1, 1};
    const FitMetrics m = metrics_of(simulated, feeding_in);
    EXPECT_TRUE(std::isnan(m.cv_rmse));
    EXPECT_TRUE(std::isnan(m.cv_rmse_n1));
    EXPECT_FALSE(meets_guideline_14(m, Resolution::hourly));
    EXPECT_DOUBLE_EQ(relative_error(m), std::sqrt(8.0));
    EXPECT_DOUBLE_EQ(relative_error(metrics_of(simulated, std::vector<double>{1, 3})),
                     std::sqrt(2.0) / 2);
}

FitMetrics with(double nmbe, double cv_rmse_n1) {
    FitMetrics m;
    m.n = 8760;
    m.nmbe = nmbe;
    m.cv_rmse_n1 = cv_rmse_n1;
    return m;
}

// ASHRAE Guideline 14-2014, section 4.2.1: monthly 5 % and 15 %, hourly 10 % and 30 %.
TEST(Guideline14, HasItsHourlyLimits) {
    EXPECT_TRUE(meets_guideline_14(with(-0.099, 0.30), Resolution::hourly));
    EXPECT_FALSE(meets_guideline_14(with(-0.101, 0.20), Resolution::hourly));
    EXPECT_FALSE(meets_guideline_14(with(0.05, 0.301), Resolution::hourly));
}

TEST(Guideline14, HasItsMonthlyLimits) {
    EXPECT_TRUE(meets_guideline_14(with(0.049, 0.15), Resolution::monthly));
    EXPECT_FALSE(meets_guideline_14(with(0.051, 0.10), Resolution::monthly));
    EXPECT_FALSE(meets_guideline_14(with(0.01, 0.151), Resolution::monthly));
}

TEST(Guideline14, IsNotMetByWhatIsUnknown) {
    EXPECT_FALSE(meets_guideline_14(with(nan, 0.1), Resolution::hourly));
    EXPECT_FALSE(meets_guideline_14(with(0.01, nan), Resolution::hourly));
    EXPECT_FALSE(meets_guideline_14(FitMetrics{}, Resolution::hourly));
}

// With 12 months the guideline's n - 1 matters: 4.7 % x 12 / 11 = 5.13 %.
TEST(Guideline14, DividesTheBiasByNMinusOne) {
    FitMetrics year = with(0.047, 0.1);
    year.n = 12;
    EXPECT_FALSE(meets_guideline_14(year, Resolution::monthly));
}

}  // namespace
}  // namespace bemcal::stats
