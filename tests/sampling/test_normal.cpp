/// Normal numbers against Wichura's published values and their own moments.
#include "sampling/normal.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

TEST(Normal, QuantilesThatWichuraPublished) {
    // Applied Statistics 37(3), p. 482: test values of PPND16.
    EXPECT_NEAR(normal_quantile(0.25), -0.6744897501960817, 1e-15);
    EXPECT_NEAR(normal_quantile(0.001), -3.090232306167814, 1e-14);
    EXPECT_NEAR(normal_quantile(1e-20), -9.262340089798408, 1e-14);
    EXPECT_EQ(normal_quantile(0.5), 0);
}

TEST(Normal, QuantileInvertsTheDistributionFunction) {
    for (double z = -8; z <= 5; z += 0.37)
        EXPECT_NEAR(normal_quantile(0.5 * std::erfc(-z / std::sqrt(2))), z,
                    z < 2 ? 1e-13 : 1e-9)
            << z;
}

TEST(Normal, DrawsHaveUnitMoments) {
    // 4 z-scores, |z| < 4.5: false alarm 3e-5.
    Stream random(3, 1, 4);
    std::vector<double> z(100'000);
    fill_standard_normal(random, z);
    double sums[5] = {};
    for (const double x : z)
        for (int k = 1; k < 5; ++k) sums[k] += std::pow(x, k);
    const double moments[] = {0, 0, 1, 0, 3}, variances[] = {0, 1, 2, 15, 96};
    const auto n = static_cast<double>(z.size());
    for (int k = 1; k < 5; ++k)
        EXPECT_LT(std::abs(sums[k] / n - moments[k]) / std::sqrt(variances[k] / n), 4.5);
}

}  // namespace
}  // namespace bemcal::sampling
