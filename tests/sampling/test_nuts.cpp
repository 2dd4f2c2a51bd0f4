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

/// x_0 normal, x_1 about x_0^2: moments by hand. With a spread of 0.3 in x_1 the arms are
/// so stiff that 4000 draws seldom reach their ends, whose fourth powers count: over 30
/// seeds the z-scores had a standard deviation of 3, with this spread one of 1.
TEST(Nuts, Banana) {
    test::PlainDensity density(2, [](auto x, auto& out) {
        const double z = x[1] - x[0] * x[0];
        out.prior = -0.5 * x[0] * x[0];
        out.prior_gradient[0] = -x[0];
        out.likelihood = -0.5 * z * z;
        out.likelihood_gradient[0] = z * 2 * x[0];
        out.likelihood_gradient[1] = -z;
    });
    SamplerOptions options;
    options.target_acceptance = 0.95;
    const auto parts = test::sample(density, options, 4, 4000);
    // 4 z-scores, |z| < 4.5: false alarm 3e-5.
    const auto z = [&](double truth, const test::Quantity& quantity) {
        return std::abs(test::z_score(parts, truth, quantity));
    };
    EXPECT_LT(z(0, [](auto x) { return x[0]; }), 4.5);
    EXPECT_LT(z(1, [](auto x) { return x[1]; }), 4.5);
    EXPECT_LT(z(2 + 1, [](auto x) { return std::pow(x[1] - 1, 2); }), 4.5);
    EXPECT_LT(z(3, [](auto x) { return x[0] * x[0] * x[1]; }), 4.5);
}

/// A probability with a beta(2, 2) prior and 3 of 20 successes, sampled through the
/// logit: beta(5, 19).
TEST(Nuts, BoundedParameterThroughItsLogit) {
    test::PlainDensity density(1, [](auto u, auto& out) {
        const double p = 1 / (1 + std::exp(-u[0])), q = 1 - p;
        out.prior = std::log(p * q) + std::log(p * q);  // the second: Jacobian
        out.prior_gradient[0] = 2 * (q - p);
        out.likelihood = 3 * std::log(p) + 17 * std::log(q);
        out.likelihood_gradient[0] = 3 * q - 17 * p;
    });
    const auto parts = test::sample(density, {}, 4, 4000);
    const auto p = [](auto u) { return 1 / (1 + std::exp(-u[0])); };
    constexpr double a = 5, b = 19, mean = a / (a + b);
    EXPECT_LT(std::abs(test::z_score(parts, mean, p)), 4.5);
    EXPECT_LT(std::abs(test::z_score(parts, mean * (1 - mean) / (a + b + 1),
                                     [&](auto u) { return std::pow(p(u) - mean, 2); })),
              4.5);
}

}  // namespace
}  // namespace bemcal::sampling
