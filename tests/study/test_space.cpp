#include "study/space.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

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

/// sum_k weight_k value_k
double weighted(const Space& space, const std::vector<double>& position,
                const std::vector<double>& weights) {
    std::vector<double> values(space.size());
    space.read(position, values);
    return std::inner_product(values.begin(), values.end(), weights.begin(), 0.0);
}

void expect_derivatives(const Space& space, const std::vector<double>& position,
                        const std::vector<double>& weights) {
    const std::size_t n = space.n_free();
    std::vector<double> gradient(n, 0), by_position(n), unused(n);
    space.log_prior(position, gradient);
    space.pull_back(position, weights, by_position);
    for (std::size_t f = 0; f < n; ++f) {
        if (space.levels()[f] > 0) {
            EXPECT_EQ(gradient[f], 0);
            EXPECT_EQ(by_position[f], 0);
            continue;
        }
        const double h = 1e-6;
        auto high = position, low = position;
        high[f] += h;
        low[f] -= h;
        EXPECT_NEAR(
            gradient[f],
            (space.log_prior(high, unused) - space.log_prior(low, unused)) / (2 * h),
            1e-7);
        EXPECT_NEAR(
            by_position[f],
            (weighted(space, high, weights) - weighted(space, low, weights)) / (2 * h),
            1e-7);
    }
}

TEST(Space, GradientsAreTheDerivatives) {
    expect_derivatives(mixed_space(), {0.7, -1.4, 1, 2.5}, {0.3, 5, -2, 1, 0.8});
}

/// Two with a size that is unknown, too.
Space sized_space(double centring = 1) {
    using stats::PriorKind;
    const double inf = std::numeric_limits<double>::infinity();
    const auto standard = made(PriorKind::normal, 0, 1, -inf, inf);
    return Space({{"size", "K", made(PriorKind::lognormal, 0, 0.7, 0, inf)},
                  {"first", "K", standard, {}, 0, centring},
                  {"second", "K", standard, {}, 0, centring}});
}

TEST(Space, ThePriorIsOfTheQuotientByTheSize) {
    const Space space = sized_space();
    const std::vector<double> position{std::log(3), 1.5, -6};
    std::vector<double> values(3), unused(3);
    space.read(position, values);
    EXPECT_NEAR(values[0], 3, 1e-12);
    EXPECT_EQ(values[1], 1.5);
    EXPECT_EQ(values[2], -6);
    EXPECT_EQ(space.position_of(values), position);
    const auto log_normal = [](double x, double sd) {
        return -0.5 * (x / sd) * (x / sd) - std::log(sd) -
               0.5 * std::log(2 * std::numbers::pi);
    };
    EXPECT_NEAR(space.log_prior(position, unused),
                log_normal(std::log(3), 0.7) + log_normal(1.5, 3) + log_normal(-6, 3),
                1e-12);
    expect_derivatives(space, position, {0.2, -1, 0.7});
}

/// On the line it is the quotient times a power of the size: densities differ by the
/// Jacobian alone.
TEST(Space, AShareOfTheSizeIsLeftOnTheLine) {
    const std::vector<double> values{3, 1.5, -6};
    std::vector<double> again(3), unused(3);
    const Space own = sized_space();
    for (const double centring : {0.0, 0.3, 1.0}) {
        const Space space = sized_space(centring);
        const std::vector<double> position = space.position_of(values);
        EXPECT_NEAR(position[1], 0.5 * std::pow(3, centring), 1e-12);
        space.read(position, again);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(again[k], values[k], 1e-12);
        EXPECT_NEAR(space.log_prior(position, unused),
                    own.log_prior(own.position_of(values), unused) +
                        2 * (1 - centring) * std::log(3),
                    1e-12);
        expect_derivatives(space, position, {0.2, -1, 0.7});
    }
}

/// 4000 draws: a mean square is missed by 5 standard errors once in 100,000, if they were
/// normal; of the quotient, which is.
TEST(Space, DrawsHaveTheSizeThatWasDrawn) {
    for (const double centring : {0.0, 0.3, 1.0}) {
        const Space space = sized_space(centring);
        Stream random(7, 1, 0);
        double sum = 0;
        std::vector<double> values(3);
        for (int k = 0; k < 4000; ++k) {
            space.read(space.draw_position(random), values);
            sum += values[1] * values[1] / (values[0] * values[0]) / 4000;
        }
        EXPECT_NEAR(sum, 1, 5 * std::sqrt(2 / 4000.0)) << centring;
    }
}

/// A step of unknown size in three days, of which it leaves out some at the beginning.
TEST(Space, AStepBringsToADayWhatLiesBehindIt) {
    using stats::PriorKind;
    const double inf = std::numeric_limits<double>::infinity();
    const auto none = made(PriorKind::fixed, 0, 0, -inf, inf);
    std::vector<Coordinate> all{{"size", "K", made(PriorKind::normal, 0, 1, -inf, inf)},
                                {"day", "d", made(PriorKind::uniform, 0, 1, -2, 2)}};
    for (const double at : {-1.0, 0.0, 1.0})
        all.push_back({"part", "K", none, {}, std::nullopt, 1, StepShare{0, 1, at}});
    const Space space(std::move(all));
    ASSERT_EQ(space.n_free(), 2U);
    std::vector<double> values(5);
    const auto at_day = [&](double day) {
        std::vector<double> wanted{3, day, 0, 0, 0};
        const auto position = space.position_of(wanted);
        space.read(position, values);
        return std::vector<double>(values.begin() + 2, values.end());
    };
    const auto expect_near = [](const std::vector<double>& a,
                                const std::vector<double>& b) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-12);
    };
    expect_near(at_day(0), {0, 3, 3});
    expect_near(at_day(-0.25), {0.75, 3, 3});
    expect_near(at_day(0.5), {0, 1.5, 3});
    expect_near(at_day(-1.5), {3, 3, 3});
    expect_derivatives(space, space.position_of(std::vector<double>{3, 0.3, 0, 0, 0}),
                       {0.2, -1, 0.7, 0.4, -0.9});
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
