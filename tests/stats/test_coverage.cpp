#include "base/random.hpp"
#include "stats/coverage.hpp"
#include "stats/distributions.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Each column has the draws 1, 2, ..., 19, in falling order.
Matrix nineteen_draws(std::size_t n) {
    Matrix draws(19, n);
    for (std::size_t d = 0; d < 19; ++d)
        for (double& x : draws.row(d)) x = 19 - static_cast<double>(d);
    return draws;
}

// Places p (19 + 1): 5 % is the first of 19, 25 % the fifth, 95 % the last.
TEST(PredictiveQuantile, LiesAtItsPlace) {
    const std::vector<double> four{1, 2, 3, 4};
    EXPECT_DOUBLE_EQ(predictive_quantile(four, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(predictive_quantile(four, 0.25), 1.25);
    EXPECT_DOUBLE_EQ(predictive_quantile(four, 0.01), 1);
    EXPECT_TRUE(std::isnan(predictive_quantile({}, 0.5)));
}

TEST(Coverage, CountsReadingsInsideTheIntervals) {
    const std::vector<double> readings{0.9, 1, 4.9, 5, 15, 15.1, 19, 19.1, nan};
    const Coverage c = coverage_of(readings, nineteen_draws(9));
    EXPECT_EQ(c.n, 8);
    EXPECT_DOUBLE_EQ(c.inside_50, 2.0 / 8);
    EXPECT_DOUBLE_EQ(c.inside_90, 6.0 / 8);
}

TEST(Coverage, IsUnknownWithoutReadingsOrDraws) {
    const std::vector<double> missing{nan, nan}, readings{1, 2};
    EXPECT_TRUE(std::isnan(coverage_of(missing, nineteen_draws(2)).inside_90));
    EXPECT_EQ(coverage_of(readings, Matrix()).n, 0);
    EXPECT_TRUE(std::isnan(pit_of(readings, Matrix()).p_value));
}

TEST(Coverage, LeavesOutReadingsWhoseDrawsAreNotFinite) {
    Matrix draws = nineteen_draws(2);
    draws(3, 1) = nan;
    const std::vector<double> readings{10, 10};
    EXPECT_EQ(coverage_of(readings, draws).n, 1);
    EXPECT_EQ(pit_of(readings, draws).n, 1);
}

TEST(Pit, CountsRanksFromBelowAllToAboveAll) {
    const std::vector<double> readings{0, 0.5, 1.5, 30, 10};  // equal to the tenth: half
    const Pit pit = pit_of(readings, nineteen_draws(5));
    EXPECT_EQ(pit.counts[0], 2);
    EXPECT_EQ(pit.counts[1], 1);
    EXPECT_EQ(pit.counts[9], 1);
    EXPECT_EQ(pit.counts[19], 1);
    for (const double expected : pit.expected) EXPECT_DOUBLE_EQ(expected, 5.0 / 20);
    // sum of (count - 1/4)^2 / (1/4): 4 (1.75^2 + 3 x 0.75^2 + 16 x 0.25^2)
    EXPECT_NEAR(pit.chi_square, 4 * (3.0625 + 3 * 0.5625 + 16 * 0.0625), 1e-12);
    EXPECT_NEAR(pit.distance, 3.0 / 5 - 2.0 / 20, 1e-12);
}

TEST(Pit, ExpectsAsManyAsTheRanksOfABin) {
    const std::vector<double> readings(30, 0.5);
    const Pit pit = pit_of(readings, Matrix(29, 30, 1.0));  // 30 ranks in 20 bins
    double sum = 0;
    for (const double expected : pit.expected) sum += expected;
    EXPECT_NEAR(sum, 30, 1e-12);
    EXPECT_NEAR(pit.expected[0], 2, 1e-12);
    EXPECT_NEAR(pit.expected[1], 1, 1e-12);
}

Matrix normals(std::size_t rows, std::size_t cols, double sd, std::uint32_t stream) {
    Matrix values(rows, cols);
    Stream random(11, stream, 0);
    for (double& value : values.values) value = sd * normal_quantile(random.uniform());
    return values;
}

// Binomial of 4000: 0.9 and 0.5 within 4 of their standard errors (0.0047, 0.0079).
// False-alarm rate of each of the three checks at another seed: below 1e-4.
TEST(CalibratedDraws, CoverAndAreUniform) {
    const Matrix readings = normals(1, 4000, 1, 1), draws = normals(50, 4000, 1, 2);
    const Coverage c = coverage_of(readings.values, draws);
    EXPECT_NEAR(c.inside_90, 0.9, 0.019);
    EXPECT_NEAR(c.inside_50, 0.5, 0.032);
    EXPECT_GT(pit_of(readings.values, draws).p_value, 1e-4);
}

TEST(NarrowDraws, CoverTooLittleAndAreNotUniform) {
    const Matrix readings = normals(1, 4000, 1, 1), draws = normals(50, 4000, 0.5, 2);
    EXPECT_LT(coverage_of(readings.values, draws).inside_90, 0.7);
    const Pit pit = pit_of(readings.values, draws);
    EXPECT_LT(pit.p_value, 1e-6);
    EXPECT_GT(pit.counts[0], 2 * pit.expected[0]);
    EXPECT_GT(pit.distance, 0.1);
}

}  // namespace
}  // namespace bemcal::stats
