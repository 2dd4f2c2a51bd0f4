#include "stats/estimate_spread.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

/// Of a mean: derivative 1 everywhere, residuals +-1 in turn or in runs.
ResidualSeries mean_of(std::size_t n, std::size_t run) {
    ResidualSeries series{{}, Matrix(1, n, 1.0)};
    for (std::size_t i = 0; i < n; ++i)
        series.residuals.push_back((i / run) % 2 == 0 ? 1.0 : -1.0);
    return series;
}

TEST(EstimateSpread, OfIndependentResidualsIsThatOfTheMean) {
    // alternating: the lag-one correlation counts as 0, so 1 / sqrt(n)
    const ResidualSeries series = mean_of(1000, 1);
    EXPECT_EQ(lag_one_correlation(series.residuals), 0);
    const double free = 1 / std::sqrt(1000.0);
    EXPECT_NEAR(estimate_spread({&series, 1}, 1)[0], 1 / std::sqrt(1000 + 12), 1e-6);
    EXPECT_NEAR(estimate_spread({&series, 1}, 1)[0], free, 0.01 * free);
}

TEST(EstimateSpread, GrowsAsResidualsFollowEachOther) {
    // runs of 100: rho = 1 - 2 / 100 about, the mean's variance (1 + rho) / (1 - rho) / n
    const ResidualSeries series = mean_of(100000, 100);
    const double rho = lag_one_correlation(series.residuals);
    EXPECT_NEAR(rho, 0.98, 0.001);
    EXPECT_NEAR(estimate_spread({&series, 1}, 1)[0],
                std::sqrt((1 + rho) / (1 - rho) / 100000), 5e-4);
}

TEST(EstimateSpread, IsTheRangesOwnWhereTheDataSayNothing) {
    ResidualSeries series = mean_of(100, 1);
    series.derivatives = Matrix(2, 100, 1.0);
    for (std::size_t i = 0; i < 100; ++i) series.derivatives(1, i) = 0;
    const auto spread = estimate_spread({&series, 1}, 2);
    EXPECT_LT(spread[0], 0.11);
    EXPECT_NEAR(spread[1], std::sqrt(1.0 / 12), 1e-9);
}

TEST(EstimateSpread, OfTwoThatActAlikeIsWide) {
    ResidualSeries series = mean_of(10000, 1);
    series.derivatives = Matrix(2, 10000, 1.0);
    for (const double spread : estimate_spread({&series, 1}, 2))
        EXPECT_NEAR(spread, std::sqrt(1.0 / 24), 0.01);
}

TEST(EstimateSpread, LeavesOutWhatIsNotRead) {
    ResidualSeries series = mean_of(2000, 1);
    for (std::size_t i = 1000; i < 2000; ++i)
        series.residuals[i] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NEAR(estimate_spread({&series, 1}, 1)[0], 1 / std::sqrt(1000 + 12), 1e-6);
}

}  // namespace
}  // namespace bemcal::stats
