/// The dynamics: reversible, and of an energy error that falls with the step squared.
#include "sampling/densities.hpp"
#include "sampling/leapfrog.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

Task<> integrate(Walker& walker, Leaf& leaf, double step_size, int n_steps) {
    for (int k = 0; k < n_steps; ++k) {
        begin_step(walker, leaf, step_size);
        co_await walker.evaluate(leaf.point);
        finish_step(walker, leaf, step_size);
    }
}

Task<> draw(Walker& walker, Leaf& leaf) {
    co_await walker.evaluate(walker.current);
    draw_leaf(walker, leaf);
}

class Leapfrog : public testing::Test {
  protected:
    Leapfrog() {
        walker.current.x = {1, -2, 3};
        walker.metric.set_covariance({2, 0.5, 0, 0.5, 1, 0.1, 0, 0.1, 3});
        run(draw(walker, leaf));
    }
    void run(Task<> task) {
        task.start();
        company.run();
        task.check();
    }

    test::PlainDensity density{
        3, [](std::span<const double> x, auto& out) {
            for (std::size_t i = 0; i < 3; ++i) {
                out.prior -= std::pow(x[i], 4) / 4;
                out.prior_gradient[i] = -std::pow(x[i], 3);
                out.likelihood += std::sin(x[i] + x[0]);
                out.likelihood_gradient[i] += std::cos(x[i] + x[0]);
                out.likelihood_gradient[0] += std::cos(x[i] + x[0]);
            }
        }};
    Company company{density, true};
    Coordinates coordinates = coordinates_of(density);
    SamplerOptions options;
    Walker walker{company, coordinates, options, 0.7, Stream(1, 1, 1)};
    Leaf leaf = walker.trajectory.root();
};

TEST_F(Leapfrog, ComesBackWhenMomentumIsReversed) {
    const Leaf start = leaf;
    run(integrate(walker, leaf, 0.05, 40));
    EXPECT_GT(std::abs(leaf.point.x[0] - start.point.x[0]), 0.1);
    for (double& p : leaf.momentum) p = -p;
    run(integrate(walker, leaf, 0.05, 40));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(leaf.point.x[i], start.point.x[i], 1e-11);
        EXPECT_NEAR(leaf.momentum[i], -start.momentum[i], 1e-11);
    }
}

TEST_F(Leapfrog, EnergyErrorFallsWithTheStepSquared) {
    const auto error_with = [&](double step_size) {
        Leaf copy = leaf;
        run(integrate(walker, copy, step_size,
                      static_cast<int>(std::lround(0.4 / step_size))));
        return std::abs(copy.energy - leaf.energy);
    };
    const double coarse = error_with(0.004), fine = error_with(0.002);
    EXPECT_GT(fine, 0);
    EXPECT_NEAR(coarse / fine, 4, 0.1);
}

TEST_F(Leapfrog, WhitenedMomentumMovesByTheCovariance) {
    // x' = x + e^2/2 L L' gradient, without momentum.
    for (double& p : leaf.momentum) p = 0;
    const Leaf start = leaf;
    std::vector<double> g(3);
    for (std::size_t i = 0; i < 3; ++i)
        g[i] = start.point.prior_gradient[i] + 0.7 * start.point.likelihood_gradient[i];
    begin_step(walker, leaf, 0.1);
    const double expected[] = {2 * g[0] + 0.5 * g[1], 0.5 * g[0] + g[1] + 0.1 * g[2],
                               0.1 * g[1] + 3 * g[2]};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(leaf.point.x[i] - start.point.x[i], 0.005 * expected[i], 1e-14);
}

}  // namespace
}  // namespace bemcal::sampling
