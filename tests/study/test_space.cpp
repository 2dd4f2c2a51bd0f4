#include "study/space.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

stats::Prior made(stats::PriorKind kind, double a, double b, double least, double most) {
    stats::Prior prior;
    prior.kind = kind;
    prior.a = a;
    prior.b = b;
    prior.least = least;
    prior.most = most;
    return prior;
}

Space mixed_space() {
    using stats::PriorKind;
    const double inf = std::numeric_limits<double>::infinity();
    return Space({{"range", "-", made(PriorKind::uniform, 0, 1, 2, 5)},
                  {"known", "-", made(PriorKind::fixed, 7, 0, -inf, inf)},
                  {"noise", "-", made(PriorKind::lognormal, -1, 0.5, 0, inf)},
                  {"glazing", "-", {}, {1.1, 2.8, 5.7}},
                  {"shift", "K", made(PriorKind::normal, 1, 2, -inf, inf)}});
}

TEST(Space, FixedOnesHaveNoCoordinateAndDiscreteOnesAWholeNumber) {
    const Space space = mixed_space();
    ASSERT_EQ(space.n_free(), 4u);
    EXPECT_EQ(space.levels(), (std::vector<int>{0, 0, 3, 0}));
    std::vector<double> values(5);
    space.read(std::vector<double>{0, std::log(0.2), 2, -3}, values);
    EXPECT_DOUBLE_EQ(values[0], 3.5);  // the middle of the range
    EXPECT_EQ(values[1], 7);
    EXPECT_DOUBLE_EQ(values[2], 0.2);
    EXPECT_EQ(values[3], 5.7);
    EXPECT_EQ(values[4], -3);
}

TEST(Space, APositionOfValuesReadsBackAsTheValues) {
    const Space space = mixed_space();
    const std::vector<double> values{4.2, 7, 0.31, 2.8, 0.4};
    std::vector<double> again(5);
    space.read(space.position_of(values), again);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(again[k], values[k], 1e-12);
}

TEST(Space, GradientAndSlopesAreTheDerivatives) {
    const Space space = mixed_space();
    const std::vector<double> position{0.7, -1.4, 1, 2.5};
    std::vector<double> gradient(4, 0), slopes(4), unused(4), above(5), below(5);
    space.log_prior(position, gradient);
    space.slopes(position, slopes);
    for (const std::size_t f : {0u, 1u, 3u}) {
        const double h = 1e-6;
        auto high = position, low = position;
        high[f] += h;
        low[f] -= h;
        EXPECT_NEAR(
            gradient[f],
            (space.log_prior(high, unused) - space.log_prior(low, unused)) / (2 * h),
            1e-7);
        space.read(high, above);
        space.read(low, below);
        const std::size_t k = space.index_of(f);
        EXPECT_NEAR(slopes[f], (above[k] - below[k]) / (2 * h), 1e-8);
    }
    EXPECT_EQ(gradient[2], 0);
    EXPECT_EQ(slopes[2], 0);
}

/// 4000 draws: the mean of a prior is missed by 4 standard errors once in 16,000.
TEST(Space, DrawsHaveThePriorsMeans) {
    const Space space = mixed_space();
    Stream random(5, 1, 0);
    std::vector<double> sum(5, 0), values(5);
    for (int k = 0; k < 4000; ++k) {
        space.read(space.draw_position(random), values);
        for (std::size_t c = 0; c < 5; ++c) sum[c] += values[c] / 4000;
    }
    EXPECT_NEAR(sum[0], 3.5, 4 * 3 / std::sqrt(12.0 * 4000));
    EXPECT_NEAR(sum[2], std::exp(-1 + 0.125), 4 * 0.222 / std::sqrt(4000.0));
    EXPECT_NEAR(sum[3], 3.2, 4 * 1.9 / std::sqrt(4000.0));
    EXPECT_NEAR(sum[4], 1, 4 * 2 / std::sqrt(4000.0));
}

}  // namespace
}  // namespace bemcal::study
