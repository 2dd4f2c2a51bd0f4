/// Draws of a normal distribution have its mean and its covariance.
#include "stats/normal_draws.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

Matrix covariance() {
    Matrix given(3, 3);
    given.values = {4, 1.5, 0, 1.5, 1, 0, 0, 0, 0};
    return given;
}

// 20,000 draws: an entry is within 5 % of the larger variance in all but one seed of
// 10,000.
TEST(NormalDraws, HaveTheCovariance) {
    constexpr std::size_t n = 20000;
    const Matrix draws = normal_draws(covariance(), n, 7);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            double sum = 0;
            for (std::size_t r = 1; r <= n; ++r) sum += draws(r, i) * draws(r, k);
            EXPECT_NEAR(sum / n, covariance()(i, k), 0.2);
        }
}

TEST(NormalDraws, BeginWithTheMeanAndAreOfTheSeed) {
    const Matrix one = normal_draws(covariance(), 5, 3),
                 two = normal_draws(covariance(), 5, 3),
                 other = normal_draws(covariance(), 5, 4);
    EXPECT_EQ(one.rows, 6U);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(one(0, k), 0);
    EXPECT_EQ(one.values, two.values);
    EXPECT_NE(one.values, other.values);
    for (std::size_t r = 0; r < one.rows; ++r) EXPECT_NEAR(one(r, 2), 0, 1e-12);
}

}  // namespace
}  // namespace bemcal::stats
