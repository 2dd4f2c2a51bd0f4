#include "sampling/chains.hpp"
#include "sampling/densities.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

/// Ten independent normals, with standard deviations from 1e-3 to 1 and means 2: far
/// narrower than the starts, as a likelihood of thousands of readings is.
constexpr std::size_t dimension = 10;

double sd_of(std::size_t k) {
    return std::pow(10, -3 + static_cast<double>(k) / 3);
}

test::PlainDensity narrow() {
    test::PlainDensity density(dimension, [](std::span<const double> x, auto& values) {
        for (std::size_t k = 0; k < dimension; ++k) {
            const double z = (x[k] - 2) / sd_of(k);
            values.likelihood -= 0.5 * z * z;
            values.likelihood_gradient[k] = -z / sd_of(k);
        }
    });
    density.set_start_spread(3);
    return density;
}

SamplerOptions quick(bool climbs) {
    SamplerOptions options;
    options.n_warm_up = 30;
    options.climbs = climbs;
    return options;
}

std::vector<ChainPart> warm_up(const SamplerOptions& options, Density& density) {
    return run_chains(density, options, {{5, 0, 0, {}}, {5, 1, 0, {}}}, 0);
}

TEST(Climb, AShortWarmUpSufficesWhereTheTargetIsFarNarrowerThanTheStarts) {
    auto density = narrow();
    const SamplerOptions options = quick(true);
    const auto warm = warm_up(options, density);
    const auto parts = run_chains(density, options, {{5, 0, 1, warm[0].state}}, 400);
    const auto n_steps = static_cast<std::size_t>(Statistic::n_steps);
    double steps = 0;
    for (std::size_t k = 0; k < dimension; ++k) {
        double mean = 0, square = 0;
        for (std::size_t d = 0; d < 400; ++d) {
            const double z = (parts[0].draws(d, k) - 2) / sd_of(k);
            mean += z / 400;
            square += z * z / 400;
            if (k == 0) steps += parts[0].statistics(d, n_steps) / 400;
        }
        // 400 draws, at least 200 of them effective: 5 standard errors
        EXPECT_NEAR(mean, 0, 5 / std::sqrt(200.0)) << k;
        EXPECT_NEAR(square, 1, 5 * std::sqrt(2.0 / 200)) << k;
    }
    EXPECT_LT(steps, 10);
}

/// Thirty normals, each close to the one before it, by a distance from 1e-5 to 1: 200
/// moves of a climb that knows twelve of them end far below the mode.
test::PlainDensity close_together() {
    return test::PlainDensity(30, [](std::span<const double> x, auto& values) {
        double before = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double sd = std::pow(10, -static_cast<double>(k * 7 % 30) / 6);
            const double z = (x[k] - before) / sd;
            values.likelihood -= 0.5 * z * z;
            values.likelihood_gradient[k] -= z / sd;
            if (k > 0) values.likelihood_gradient[k - 1] += z / sd;
            before = x[k];
        }
    });
}

TEST(Climb, GoesOnByTheCurvatureWhereOneClimbEndsTooEarly) {
    auto density = close_together();
    SamplerOptions options = quick(true);
    options.n_warm_up = 0;
    for (const ChainPart& part : warm_up(options, density)) {
        Evaluations values;
        Matrix x(1, 30);
        std::copy_n(part.state.begin() + 2, 30, x.values.begin());
        density.evaluate(x, false, values);
        // -1/2 chi-squared of 30 degrees of freedom: 85 has a chance of 1e-6
        EXPECT_GT(values.likelihood[0], -0.5 * 85);
    }
}

/// The logarithm of a size, and fifty numbers of that size that nothing is known of.
class Sized : public test::PlainDensity {
  public:
    explicit Sized(bool holds)
        : PlainDensity(51,
                       [](std::span<const double> x, auto& values) {
                           values.prior = -x[0] * x[0];
                           values.prior_gradient[0] = -2 * x[0];
                           for (std::size_t k = 1; k < x.size(); ++k) {
                               const double z = x[k] / std::exp(x[0]);
                               values.prior -= 0.5 * z * z + x[0];
                               values.prior_gradient[k] = -z / std::exp(x[0]);
                               values.prior_gradient[0] += z * z - 1;
                           }
                       }),
          holds_(holds) {}
    std::vector<char> held_in_climb() const override {
        std::vector<char> held(dimension(), 0);
        held[0] = holds_ ? 1 : 0;
        return held;
    }

  private:
    bool holds_;
};

/// The mode is at a logarithm of -25, where no draw of the density ever is.
TEST(Climb, LeavesTheSizeOfOthersWhereItStarts) {
    SamplerOptions options = quick(true);
    options.n_warm_up = 0;
    for (const bool holds : {true, false}) {
        Sized density(holds);
        for (const ChainPart& part : warm_up(options, density)) {
            const double log_size = part.state.at(2);
            EXPECT_EQ(std::abs(log_size) < 5, holds) << log_size;
        }
    }
}

TEST(ShareMetric, GivesAllChainsTheStepAndMetricOfOneAndLeavesTheRest) {
    auto density = narrow();
    const auto warm = warm_up(quick(true), density);
    std::vector<std::vector<double>> states{warm[0].state, {}, warm[1].state};
    const auto before = states;
    share_metric(density, quick(true), states);
    const auto step_size = static_cast<std::ptrdiff_t>(2 + dimension);
    EXPECT_TRUE(states[1].empty());
    for (const std::size_t c : {std::size_t{0}, std::size_t{2}})
        EXPECT_TRUE(std::equal(states[c].begin(), states[c].begin() + step_size,
                               before[c].begin()));
    EXPECT_TRUE(std::equal(states[0].begin() + step_size, states[0].end(),
                           states[2].begin() + step_size));
    const std::size_t larger =
        before[0][2 + dimension] > before[2][2 + dimension] ? 0 : 2;
    EXPECT_EQ(states[0][2 + dimension], before[larger][2 + dimension]);
}

TEST(ShareMetric, IsForChainsThatClimbedOnly) {
    auto density = narrow();
    const auto warm = warm_up(quick(false), density);
    std::vector<std::vector<double>> states{warm[0].state, warm[1].state};
    const auto before = states;
    share_metric(density, quick(false), states);
    EXPECT_EQ(states, before);
}

}  // namespace
}  // namespace bemcal::sampling
