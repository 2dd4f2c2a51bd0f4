/// Normal numbers: their moments.
#include "sampling/normal.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

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
