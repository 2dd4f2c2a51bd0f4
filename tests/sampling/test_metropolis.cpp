/// Random walk, Metropolis within Gibbs and whole numbers on targets with known moments.
#include "sampling/densities.hpp"
#include "sampling/quantities.hpp"
#include "support/measured.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

double mean_acceptance(const std::vector<ChainPart>& parts) {
    double sum = 0, n = 0;
    for (const ChainPart& part : parts)
        for (std::size_t i = 0; i < part.statistics.rows; ++i, ++n)
            sum += part.statistics(i, static_cast<std::size_t>(Statistic::acceptance));
    return sum / n;
}

struct MethodCase {
    Method method;
    double target;
    int n_warm_up, n_draws;
};

void expect_gaussian(const MethodCase& c, const test::Gaussian& gaussian) {
    test::PlainDensity density(gaussian.dimension, gaussian);
    SamplerOptions options;
    options.method = c.method;
    options.n_warm_up = c.n_warm_up;
    const auto parts = test::sample(density, options, 4, c.n_draws);
    EXPECT_NEAR(mean_acceptance(parts), c.target, 0.06);
    double least = 1e300;
    for (std::size_t i = 0; i < gaussian.dimension; ++i) {
        const double mean = gaussian.mean(i), sd = gaussian.scale(i);
        const auto u = [=](std::span<const double> x) { return (x[i] - mean) / sd; };
        EXPECT_LT(std::abs(test::z_score(parts, 0, u)), 4.5) << i;
        EXPECT_LT(std::abs(test::z_score(parts, 1, [&](auto x) { return u(x) * u(x); })),
                  4.5)
            << i;
        least = std::min(least, test::estimate(parts, u).ess);
    }
    test::print_measured(std::string("least ess per draw, ") + name_of(c.method),
                         least / 4 / c.n_draws, "-", "");
}

// |z| < 4.5 of 8 and 16 z-scores: false alarm 2e-4 together.
TEST(RandomWalk, CorrelatedGaussianOfUnequalScales) {
    expect_gaussian({Method::random_walk, 0.234, 4000, 20'000}, {8, 0.9, 100});
}

TEST(Gibbs, CorrelatedGaussianOfUnequalScales) {
    expect_gaussian({Method::gibbs, 0.44, 500, 10'000}, {4, 0.6, 100});
}

/// A value k of 4 with prior weights 1 : 2 : 3 : 4 and a real x about k with spread 0.7.
void mixture(std::span<const double> x, test::PlainDensity::Values& out) {
    const double z = (x[1] - x[0]) / 0.7;
    out.prior = std::log(1 + x[0]);
    out.likelihood = -0.5 * z * z;
    out.likelihood_gradient[1] = -z / 0.7;
}

class WholeNumbers : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(All, WholeNumbers,
                         testing::Values(Method::nuts, Method::random_walk,
                                         Method::gibbs),
                         [](const auto& c) { return std::string(name_of(c.param)); });

TEST_P(WholeNumbers, TakeTheirKnownShares) {
    // 6 z-scores of 3 methods, |z| < 4.5: false alarm 1.3e-4.
    test::PlainDensity density(2, mixture);
    density.set_levels({4, 0});
    SamplerOptions options;
    options.method = GetParam();
    const auto parts = test::sample(density, options, 4, 10'000);
    for (int k = 0; k < 4; ++k)
        EXPECT_LT(std::abs(test::z_score(parts, (k + 1) / 10.0,
                                         [=](auto x) { return x[0] == k ? 1.0 : 0.0; })),
                  4.5)
            << k;
    EXPECT_LT(std::abs(test::z_score(parts, 2, [](auto x) { return x[1]; })), 4.5);
    EXPECT_LT(std::abs(test::z_score(
                  parts, 0.49, [](auto x) { return (x[1] - x[0]) * (x[1] - x[0]); })),
              4.5);
}

TEST_P(WholeNumbers, NeedNoRealCoordinate) {
    test::PlainDensity density(2, [](auto x, auto& out) {
        out.prior = std::log(1 + x[0]);
        out.likelihood = x[0] == 0 && x[1] == 1 ? -HUGE_VAL : 0;
    });
    density.set_levels({2, 2});
    SamplerOptions options;
    options.method = GetParam();
    // Shares: (0, 0) 1, (1, 0) 2, (1, 1) 2.
    const auto parts = test::sample(density, options, 4, 5000);
    EXPECT_LT(
        std::abs(test::z_score(parts, 0.2, [](auto x) { return x[0] == 0 ? 1.0 : 0.0; })),
        4.5);
    EXPECT_LT(std::abs(test::z_score(parts, 0.4, [](auto x) { return x[1]; })), 4.5);
}

}  // namespace
}  // namespace bemcal::sampling
