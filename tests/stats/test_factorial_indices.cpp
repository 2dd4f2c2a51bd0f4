#include "stats/factorial_indices.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

using Axes = std::vector<std::vector<double>>;

std::vector<double> spread(std::size_t n) {
    std::vector<double> values;
    for (std::size_t k = 0; k < n; ++k)
        values.push_back(static_cast<double>(k) / static_cast<double>(n - 1));
    return values;
}

template <class Function>
std::vector<double> on_grid(const Axes& axes, Function f) {
    std::vector<double> outputs;
    for (const double a : axes[0])
        for (const double b : axes[1])
            for (const double c : axes[2]) outputs.push_back(f(a, b, c));
    return outputs;
}

// f = a + 2 b + 4 b c on [0, 1]^3: Var(a) = 1/12; with g = 2 b + 4 b c, E[g|b] = 4 b,
// Var = 16/12; E[g|c] = 1 + 2 c, Var = 4/12; interaction E[g^2] - .. = 16/144.
// Total: V = 1/12 + 16/12 + 4/12 + 1/9 = 67/36; S_T = 3/67, (48 + 4)/67, (12 + 4)/67.
TEST(TotalOrderOnAGrid, IsExactForAMultilinearFunctionOnAnyGrid) {
    const Axes grids[] = {{{0, 1}, {0, 1}, {0, 1}},
                          {{0, 0.1, 1}, {0, 0.3, 0.35, 1}, {0, 0.9, 1}}};
    for (const Axes& axes : grids) {
        const auto f = [](double a, double b, double c) { return a + 2 * b + 4 * b * c; };
        const std::vector<double> indices = total_order_on_grid(axes, on_grid(axes, f));
        EXPECT_NEAR(indices[0], 3.0 / 67, 1e-12);
        EXPECT_NEAR(indices[1], 52.0 / 67, 1e-12);
        EXPECT_NEAR(indices[2], 16.0 / 67, 1e-12);
    }
}

// The Ishigami function (a = 7, b = 0.1), total indices 0.5576, 0.4424, 0.2437.
TEST(TotalOrderOnAGrid, ConvergesToThePublishedIndices) {
    const double pi = std::acos(-1.0);
    Axes axes(3, spread(41));
    for (auto& axis : axes)
        for (double& x : axis) x = pi * (2 * x - 1);
    const auto ishigami = [](double a, double b, double c) {
        return std::sin(a) + 7 * std::pow(std::sin(b), 2) +
               0.1 * std::pow(c, 4) * std::sin(a);
    };
    const auto indices = total_order_on_grid(axes, on_grid(axes, ishigami));
    EXPECT_NEAR(indices[0], 0.5576, 0.005);
    EXPECT_NEAR(indices[1], 0.4424, 0.005);
    EXPECT_NEAR(indices[2], 0.2437, 0.005);
}

TEST(TotalOrderOnAGrid, IsZeroForAnArgumentOfOneValueOrWithoutEffect) {
    const Axes axes{{0, 1, 2}, {5}, {1, 3}};
    const auto indices = total_order_on_grid(
        axes, on_grid(axes, [](double a, double b, double) { return a * b; }));
    EXPECT_NEAR(indices[0], 1, 1e-12);
    EXPECT_NEAR(indices[1], 0, 1e-12);
    EXPECT_NEAR(indices[2], 0, 1e-12);
}

TEST(TotalOrderOnAGrid, IsUnknownWithoutVariationOrWithAFailedRun) {
    const Axes axes{{0, 1}, {0, 1}};
    const std::vector<double> flat(4, 12178.5);
    std::vector<double> failed{1, 2, 3, std::numeric_limits<double>::quiet_NaN()};
    EXPECT_TRUE(std::isnan(total_order_on_grid(axes, flat)[0]));
    EXPECT_TRUE(std::isnan(total_order_on_grid(axes, failed)[1]));
}

TEST(TotalOrderOnAGrid, RefusesOutputsOfAnotherSize) {
    const std::vector<double> three(3, 1.0);
    EXPECT_THROW(total_order_on_grid({{0, 1}, {0, 1}}, three), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::stats
