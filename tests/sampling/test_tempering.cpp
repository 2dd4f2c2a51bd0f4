/// Two modes far apart, weighed right by a tempered chain.
#include "sampling/densities.hpp"
#include "sampling/quantities.hpp"
#include "sampling/temperatures.hpp"
#include "support/measured.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

/// The prior is normal with sd 5 in each of 3 coordinates, the likelihood 0.2 N(-4, 0.5)
/// + 0.8 N(4, 0.25) in each of them.
constexpr double prior_sd = 5;
struct Mode {
    double weight, place, sd;
};
constexpr Mode modes[] = {{0.2, -4, 0.5}, {0.8, 4, 0.25}};
constexpr std::size_t dimension = 3;

double log_normal(double z, double sd) {
    return -0.5 * z * z / sd / sd - std::log(sd);
}

void two_modes(std::span<const double> x, test::PlainDensity::Values& out) {
    double logs[2], sum = 0;
    for (int k = 0; k < 2; ++k) {
        logs[k] = std::log(modes[k].weight);
        for (const double v : x) logs[k] += log_normal(v - modes[k].place, modes[k].sd);
    }
    const double most = std::max(logs[0], logs[1]);
    for (const double l : logs) sum += std::exp(l - most);
    out.likelihood = most + std::log(sum);
    for (std::size_t i = 0; i < x.size(); ++i) {
        out.prior += log_normal(x[i], prior_sd);
        out.prior_gradient[i] = -x[i] / prior_sd / prior_sd;
        for (int k = 0; k < 2; ++k)
            out.likelihood_gradient[i] += std::exp(logs[k] - out.likelihood) *
                                          (modes[k].place - x[i]) / modes[k].sd /
                                          modes[k].sd;
    }
}

/// Of the first mode: each weighs as much as its normal does under the prior's.
double share_of_first() {
    double weights[2];
    for (int k = 0; k < 2; ++k) {
        const double sd = std::hypot(prior_sd, modes[k].sd);
        weights[k] =
            modes[k].weight * std::exp(dimension * log_normal(modes[k].place, sd));
    }
    return weights[0] / (weights[0] + weights[1]);
}

class Tempering : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(All, Tempering,
                         testing::Values(Method::nuts, Method::random_walk,
                                         Method::gibbs),
                         [](const auto& c) { return std::string(name_of(c.param)); });

TEST_P(Tempering, WeighsSeparateModes) {
    // 3 z-scores of 3 methods, |z| < 4.5: false alarm 6e-5.
    test::PlainDensity density(dimension, two_modes);
    SamplerOptions options;
    options.method = GetParam();
    options.inverse_temperatures = {1, 0.3, 0.1, 0.03, 0.01, 0.003};
    const int n_draws = 3000;
    const auto parts = test::sample(density, options, 4, n_draws);
    const test::Quantity is_first = [](auto x) { return x[0] < 0 ? 1.0 : 0.0; };
    EXPECT_LT(std::abs(test::z_score(parts, share_of_first(), is_first)), 4.5);
    EXPECT_GT(test::estimate(parts, is_first).ess, 120);
    // Within the second mode: conjugate mean and variance.
    const double variance = 1 / (1 / 0.0625 + 1 / 25.0), mean = variance * 4 / 0.0625;
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_LT(std::abs(test::z_score(
                      parts, 0, [=](auto x) { return x[0] > 0 ? x[i] - mean : 0.0; })),
                  4.5);
    test::print_measured(std::string("ess of the mode per draw, ") + name_of(GetParam()),
                         test::estimate(parts, is_first).ess / 4 / n_draws, "-",
                         "> 0.01");
}

TEST_P(Tempering, IsNeededHere) {
    test::PlainDensity density(dimension, two_modes);
    SamplerOptions options;
    options.method = GetParam();
    for (const ChainPart& part : test::sample(density, options, 4, 1000))
        for (std::size_t i = 1; i < part.draws.rows; ++i)
            EXPECT_GT(part.draws(i, 0) * part.draws(0, 0), 0)
                << "crossed without tempering";
}

TEST(Swaps, AreReportedAndFrequent) {
    test::PlainDensity density(dimension, two_modes);
    SamplerOptions options;
    options.inverse_temperatures = {1, 0.5};
    for (const ChainPart& part : test::sample(density, options, 2, 1000)) {
        double sum = 0;
        for (std::size_t i = 0; i < part.draws.rows; ++i)
            sum += part.statistics(i, static_cast<std::size_t>(Statistic::swapped));
        EXPECT_GT(sum / 1000, 0.4);
        EXPECT_LT(sum / 1000, 0.9);
    }
}

TEST(Temperatures, StandAtEqualStepsOfTheBarrier) {
    // Barrier 0, 0.6, 0.9, 1.2 at 1, 0.5, 0.2, 0: a third of it, 0.4, after 2/3 of the
    // first step, 0.8 after 2/3 of the second; the steps are even in logarithms.
    const auto equal = equalised({1, 0.5, 0.2, 0}, {0.6, 0.3, 0.3});
    const double expected[] = {1, std::pow(0.5, 2.0 / 3), 0.5 * std::pow(0.4, 2.0 / 3),
                               0};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(equal[i], expected[i], 1e-15);
    const std::vector<double> ladder{1, 0.5, 0.2};
    EXPECT_EQ(equalised(ladder, {0, 0}), ladder);
    EXPECT_NEAR(equalised({1, 0.5, 0}, {0.1, 0.3})[1], 0.5 * (1 - 1.0 / 3), 1e-15);
}

/// Prior and likelihood normal in 10 coordinates, with sd 10 and 1.
void two_normals(std::span<const double> x, test::PlainDensity::Values& out) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        out.prior -= 0.5 * x[i] * x[i] / 100;
        out.prior_gradient[i] = -x[i] / 100;
        out.likelihood -= 0.5 * x[i] * x[i];
        out.likelihood_gradient[i] = -x[i];
    }
}

/// How often neighbours at these inverse temperatures swap there, from exact draws.
double swap_rate(double cold, double hot) {
    Stream random(2, 0, 0);
    const auto log_likelihood = [&](double t) {
        double sum = 0;
        for (int i = 0; i < 10; ++i) sum += std::pow(standard_normal(random), 2);
        return -0.5 * sum / (t + 0.01);
    };
    double sum = 0;
    constexpr int n = 5000;
    for (int k = 0; k < n; ++k)
        sum += std::min(
            1.0, std::exp((cold - hot) * (log_likelihood(hot) - log_likelihood(cold))));
    return sum / n;
}

TEST(Temperatures, AdaptToEqualSwaps) {
    test::PlainDensity density(10, two_normals);
    SamplerOptions options;
    options.n_warm_up = 1000;
    options.inverse_temperatures = {1, 0.95, 0.9, 0.8, 0.02};  // far too steep at the end
    const auto warm = run_chains(density, options, {{1, 0, 0, {}}}, 0).at(0);
    // A walker's part of the state: inverse temperature, point, step size, metric.
    const std::size_t stride = 1 + 10 + 1 + 100;
    ASSERT_EQ(warm.state.size(), 1 + 5 * stride);
    const auto t = [&](std::size_t i) { return warm.state[1 + i * stride]; };
    EXPECT_EQ(t(0), 1);
    EXPECT_EQ(t(4), 0.02);
    double least = 1, most = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        least = std::min(least, swap_rate(t(i), t(i + 1)));
        most = std::max(most, swap_rate(t(i), t(i + 1)));
    }
    test::print_measured("least swap rate, adapted", least, "-", "> 0.1");
    test::print_measured("most swap rate, adapted", most, "-", "< 0.45");
    EXPECT_GT(least, 0.1);
    EXPECT_LT(most, 0.45);
    EXPECT_LT(swap_rate(0.8, 0.02), 1e-3) << "the ladder given";
    options.adapt_temperatures = false;
    const auto fixed = run_chains(density, options, {{1, 0, 0, {}}}, 0).at(0);
    EXPECT_EQ(fixed.state[1 + 3 * stride], 0.8);
}

}  // namespace
}  // namespace bemcal::sampling
