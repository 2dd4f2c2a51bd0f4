/// Two modes far apart, weighed right by a tempered chain.
#include "sampling/densities.hpp"
#include "sampling/quantities.hpp"
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
    const auto parts = test::sample(density, options, 4, 5000);
    const test::Quantity is_first = [](auto x) { return x[0] < 0 ? 1.0 : 0.0; };
    EXPECT_LT(std::abs(test::z_score(parts, share_of_first(), is_first)), 4.5);
    EXPECT_GT(test::estimate(parts, is_first).ess, 200);
    // Within the second mode: conjugate mean and variance.
    const double variance = 1 / (1 / 0.0625 + 1 / 25.0), mean = variance * 4 / 0.0625;
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_LT(std::abs(test::z_score(
                      parts, 0, [=](auto x) { return x[0] > 0 ? x[i] - mean : 0.0; })),
                  4.5);
    test::print_measured(std::string("ess of the mode per draw, ") + name_of(GetParam()),
                         test::estimate(parts, is_first).ess / 20'000, "-", "> 0.01");
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

}  // namespace
}  // namespace bemcal::sampling
