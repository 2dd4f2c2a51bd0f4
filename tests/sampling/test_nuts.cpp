/// The no-U-turn sampler on targets whose moments are known.
#include "sampling/densities.hpp"
#include "sampling/quantities.hpp"
#include "support/measured.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

double n_gradients(const std::vector<ChainPart>& parts) {
    double sum = 0;
    for (const ChainPart& part : parts)
        for (std::size_t i = 0; i < part.statistics.rows; ++i)
            sum += part.statistics(i, static_cast<std::size_t>(Statistic::n_steps));
    return sum;
}

/// 60 z-scores, |z| < 4.5: false alarm 4e-4.
void expect_gaussian(const std::vector<ChainPart>& parts, const test::Gaussian& target) {
    for (std::size_t i = 0; i < target.dimension; ++i) {
        const double mean = target.mean(i), sd = target.scale(i);
        const auto u = [=](std::span<const double> x) { return (x[i] - mean) / sd; };
        EXPECT_LT(std::abs(test::z_score(parts, 0, u)), 4.5) << i;
        EXPECT_LT(std::abs(test::z_score(parts, 1, [&](auto x) { return u(x) * u(x); })),
                  4.5)
            << i;
        // The 5 % quantile.
        EXPECT_LT(
            std::abs(test::z_score(
                parts, 0.05, [&](auto x) { return u(x) < -1.6448536 ? 1.0 : 0.0; })),
            4.5)
            << i;
    }
}

TEST(Nuts, CorrelatedGaussian) {
    const test::Gaussian target{20};
    for (const bool dense : {true, false}) {
        test::PlainDensity density(20, target, 4);
        SamplerOptions options;
        options.dense_metric = dense;
        const auto parts = test::sample(density, options, 4, 2000);
        expect_gaussian(parts, target);
        double least = 1e300;
        for (std::size_t i = 0; i < 20; ++i)
            least =
                std::min(least, test::estimate(parts, [=](auto x) { return x[i]; }).ess);
        test::print_measured(
            dense ? "ess per gradient, dense" : "ess per gradient, diagonal",
            least / n_gradients(parts), "-", "-");
    }
}

}  // namespace
}  // namespace bemcal::sampling
