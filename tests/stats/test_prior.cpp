#include "stats/prior.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Every kind: whole, cut on one side or both, normalised.
std::vector<Prior> ordinary_priors() {
    return {
        {PriorKind::uniform, 0, 1, -3, 5},
        {PriorKind::normal, 2, 0.5},
        {PriorKind::normal, 2, 0.5, 1},
        {PriorKind::normal, 2, 0.5, -infinity, 2.2},
        {PriorKind::normal, 2, 0.5, 1.5, 4},
        {PriorKind::normal, 0.085, 0.2, 10, 50, true},
        {PriorKind::lognormal, 0.2, 0.5},
        {PriorKind::lognormal, 0.2, 0.5, 0.5, 4},
        {PriorKind::lognormal, 0.2, 0.5, 0, 4},
        {PriorKind::lognormal, -1, 0.5, 3, 5, true},
        {PriorKind::beta, 2, 5, 0, 1},
        {PriorKind::beta, 0.7, 1, -2, 6},
        {PriorKind::beta, 0.4, 1, 0, 1},
        {PriorKind::gamma, 3, 2},
        {PriorKind::gamma, 3, 2, 0.5, 4},
        {PriorKind::gamma, 3, 2, 0.5},
        {PriorKind::gamma, 0.6, 2, 0, 4},
        {PriorKind::gamma, 10, 20, 100, 200, true},
    };
}

/// And far out in the tails.
std::vector<Prior> priors() {
    std::vector<Prior> all = ordinary_priors();
    all.push_back({PriorKind::normal, 0, 1, 8, 9});
    all.push_back({PriorKind::normal, 0, 1, -9, -8});
    return all;
}

std::string words(const Prior& p) {
    return std::string(name_of(p.kind)) + "(" + std::to_string(p.a) + ", " +
           std::to_string(p.b) + ") in " + std::to_string(p.least) + " to " +
           std::to_string(p.most);
}

struct Expected {
    Prior prior;
    double x, log_density, cdf, mean, sd;
};

// By mpmath 1.2 with 40 digits: quadrature of the cut density.
TEST(CutPriors, AgreeWithQuadratureOfManyDigits) {
    const std::vector<Expected> table{{{PriorKind::normal, 0.085, 0.2, 0, 1},
                                       0.3,
                                       0.5212879771226258,
                                       0.7875573509601734,
                                       0.19468758930810048,
                                       0.1365348489747517},
                                      {{PriorKind::normal, 0, 1, 8, 9},
                                       8.1,
                                       1.2896800602324754,
                                       0.5583754014201245,
                                       8.121188992979796,
                                       0.11894764723502567},
                                      {{PriorKind::gamma, 3, 2, 0.5, 4},
                                       1,
                                       -0.5149285550059493,
                                       0.26825280189006484,
                                       1.5541210158072718,
                                       0.7443925680775333},
                                      {{PriorKind::lognormal, 0.2, 0.5, 0.5, 4},
                                       1,
                                       -0.25884882743015725,
                                       0.32233396902506073,
                                       1.3900890740792098,
                                       0.6477936534870923}};
    for (const Expected& e : table) {
        EXPECT_NEAR(e.prior.log_density(e.x), e.log_density, 1e-12) << words(e.prior);
        EXPECT_NEAR(e.prior.cdf(e.x), e.cdf, 1e-12) << words(e.prior);
        EXPECT_NEAR(e.prior.mean(), e.mean, 1e-11) << words(e.prior);
        EXPECT_NEAR(e.prior.sd(), e.sd, 1e-11) << words(e.prior);
    }
}

TEST(WholePriors, HaveTheirClosedForms) {
    const Prior uniform{PriorKind::uniform, 0, 1, -3, 5};
    EXPECT_DOUBLE_EQ(uniform.log_density(4), -std::log(8));
    EXPECT_DOUBLE_EQ(uniform.mean(), 1);
    EXPECT_DOUBLE_EQ(uniform.sd(), 8 / std::sqrt(12));
    EXPECT_DOUBLE_EQ(uniform.quantile(0.25), -1);
    const Prior normal{PriorKind::normal, 2, 0.5};
    EXPECT_DOUBLE_EQ(normal.log_density(3), -2 - std::log(0.5 * std::sqrt(2 * M_PI)));
    const Prior gamma{PriorKind::gamma, 3, 2};  // 2^3 / 2! x^2 exp(-2 x)
    EXPECT_NEAR(gamma.log_density(1.5), std::log(4 * 2.25) - 3, 1e-14);
    const Prior beta{PriorKind::beta, 2, 5, 10, 20};  // 30 t (1 - t)^4 / 10
    EXPECT_NEAR(beta.log_density(13), std::log(3 * 0.3 * std::pow(0.7, 4)), 1e-14);
    EXPECT_DOUBLE_EQ(beta.mean(), 10 + 20.0 / 7);
    const Prior lognormal{PriorKind::lognormal, 0.2, 0.5};
    EXPECT_NEAR(lognormal.log_density(1), std::log(0.7365402806066467), 1e-14);  // scipy
}

TEST(NormalisedPriors, AreThoseOfTheShareOfTheRange) {
    const Prior share{PriorKind::normal, 0.085, 0.2, 0, 1};
    const Prior physical{PriorKind::normal, 0.085, 0.2, 10, 50, true};
    EXPECT_NEAR(physical.log_density(22), share.log_density(0.3) - std::log(40), 1e-13);
    EXPECT_NEAR(physical.cdf(22), share.cdf(0.3), 1e-14);
    EXPECT_NEAR(physical.quantile(0.9), 10 + 40 * share.quantile(0.9), 1e-12);
    EXPECT_NEAR(physical.mean(), 10 + 40 * share.mean(), 1e-12);
    EXPECT_NEAR(physical.sd(), 40 * share.sd(), 1e-12);
    EXPECT_DOUBLE_EQ((Prior{PriorKind::fixed, 0.25, 1, 10, 50, true}).mean(), 20);
}

/// The integral over the support, on the real line: dx = slope du.
double integral_of(const Prior& prior) {
    const Transform transform = transform_of(prior);
    const PriorDensity density(prior);
    const double centre = transform.inverse(prior.quantile(0.5));
    double sum = 0;
    constexpr double step = 0.01;
    for (double v = -80; v < 80; v += step)
        sum += step * std::exp(density.on_the_line(centre + v).value);
    return sum;
}

TEST(Priors, IntegrateToOne) {
    for (const Prior& prior : priors())
        EXPECT_NEAR(integral_of(prior), 1, 1e-9) << words(prior);
    // a hundredth of its mass lies within 1e-5 of 1
    EXPECT_NEAR(integral_of({PriorKind::beta, 1, 0.4, 0, 1}), 1, 1e-9);
}

TEST(Priors, HaveTheDerivativeOfTheirLogDensity) {
    for (const Prior& prior : priors())
        for (const double p : {0.05, 0.3, 0.7, 0.95}) {
            const double x = prior.quantile(p);
            const double room = std::min({prior.sd(), x - prior.least, prior.most - x});
            const double step = 1e-5 * room;
            const double difference =
                (prior.log_density(x + step) - prior.log_density(x - step)) / (2 * step);
            EXPECT_NEAR(PriorDensity(prior).at(x).derivative, difference,
                        1e-6 * (1 + std::abs(difference)))
                << words(prior) << " at " << x;
        }
}

TEST(Priors, ComeBackFromTheirQuantiles) {
    for (const Prior& prior : priors())
        for (const double p : {1e-6, 0.01, 0.5, 0.99, 1 - 1e-6}) {
            EXPECT_NEAR(prior.cdf(prior.quantile(p)), p, 1e-9) << words(prior);
            EXPECT_GE(prior.quantile(p), prior.least);
            EXPECT_LE(prior.quantile(p), prior.most);
        }
}

TEST(Priors, AreImpossibleOutsideTheirRange) {
    for (const Prior& prior : priors()) {
        if (std::isfinite(prior.least)) {
            EXPECT_EQ(prior.log_density(prior.least - 1e-9), -infinity);
            EXPECT_EQ(prior.cdf(prior.least - 1e-9), 0);
        }
        if (std::isfinite(prior.most)) {
            EXPECT_EQ(prior.log_density(prior.most + 1e-9), -infinity);
            EXPECT_EQ(prior.cdf(prior.most + 1e-9), 1);
        }
    }
    EXPECT_EQ((Prior{PriorKind::gamma, 3, 2}.log_density(-1)), -infinity);
    EXPECT_EQ((Prior{PriorKind::lognormal, 0, 1}.log_density(0)), -infinity);
}

/// Mean and sd once more, from 4000 quantiles in the middle of equal shares.
TEST(Priors, HaveTheMomentsOfTheirQuantiles) {
    for (const Prior& prior : priors()) {
        constexpr int n = 4000;
        const double mean = prior.mean(), sd = prior.sd();
        double sum = 0, square = 0;
        for (int k = 0; k < n; ++k) {
            const double x = prior.quantile((k + 0.5) / n) - mean;
            sum += x / n;
            square += x * x / n;
        }
        EXPECT_NEAR(sum, 0, 2e-3 * sd) << words(prior);
        EXPECT_NEAR(std::sqrt(square), sd, 5e-3 * sd) << words(prior);
    }
}

TEST(Transforms, HaveTheSlopeOfTheirDifferences) {
    for (const Prior& prior : priors()) {
        const Transform transform = transform_of(prior);
        for (const double u : {-3.0, -0.4, 0.0, 1.0, 2.5}) {
            const double h = 1e-5;
            const Mapped before = transform.at(u - h), here = transform.at(u),
                         after = transform.at(u + h);
            EXPECT_NEAR(here.slope, (after.x - before.x) / (2 * h),
                        1e-6 * (std::abs(here.slope) + std::abs(here.x) * 1e-4));
            EXPECT_GT(here.slope, 0);
            EXPECT_NEAR(here.log_slope, std::log(here.slope), 1e-12);
            EXPECT_NEAR(here.log_slope_derivative,
                        (after.log_slope - before.log_slope) / (2 * h), 1e-8);
            EXPECT_NEAR(transform.inverse(here.x), u, 1e-9);
        }
    }
}

TEST(Transforms, StayInTheSupport) {
    for (const Prior& prior : priors()) {
        const Transform transform = transform_of(prior);
        for (const double u : {-1e4, -700.0, -40.0, 40.0, 700.0, 1e4}) {
            EXPECT_GE(transform.at(u).x, transform.least) << words(prior);
            EXPECT_LE(transform.at(u).x, transform.most) << words(prior);
        }
    }
}

TEST(PriorDensities, OnTheLineAreThoseOfXWithTheJacobian) {
    for (const Prior& prior : priors()) {
        const PriorDensity density(prior);
        const Transform transform = transform_of(prior);
        for (const double p : {0.02, 0.4, 0.98}) {
            const double u = transform.inverse(prior.quantile(p));
            const Mapped mapped = transform.at(u);
            EXPECT_NEAR(density.on_the_line(u).value,
                        prior.log_density(mapped.x) + mapped.log_slope, 1e-9)
                << words(prior);
            const double h = 1e-5;
            const double difference =
                (density.on_the_line(u + h).value - density.on_the_line(u - h).value) /
                (2 * h);
            EXPECT_NEAR(density.on_the_line(u).derivative, difference,
                        1e-6 * (1 + std::abs(difference)))
                << words(prior);
        }
    }
}

TEST(PriorDensities, AreNumbersFarOutOnTheLine) {
    for (const Prior& prior : priors()) {
        const PriorDensity density(prior);
        for (const double u : {-1e4, -700.0, -40.0, 40.0, 700.0, 1e4}) {
            const LogDensity at = density.on_the_line(u);
            EXPECT_FALSE(std::isnan(at.value)) << words(prior) << " at " << u;
            EXPECT_FALSE(std::isnan(at.derivative)) << words(prior) << " at " << u;
            EXPECT_LT(at.value, -1) << words(prior) << " at " << u;
            // it rises towards the middle, but where x itself has no double
            const bool is_rising = at.derivative * u < 0;
            EXPECT_TRUE(is_rising || std::abs(u) > 700) << words(prior) << " at " << u;
        }
    }
}

// t^(a - 1) (1 - t)^(b - 1) at t = exp(-700), where 1 - t is 1: (a - 1) log t - log B.
TEST(PriorDensities, AreExactWhereXIsRoundedToAnEnd) {
    const PriorDensity beta(Prior{PriorKind::beta, 2, 3, 100, 200});  // B = 1/12
    EXPECT_EQ(beta.transform().at(-700).x, 100);
    EXPECT_NEAR(beta.on_the_line(-700).value, 2 * -700 + std::log(12), 1e-10);
    EXPECT_NEAR(beta.on_the_line(700).value, 3 * -700 + std::log(12), 1e-10);
    EXPECT_NEAR(beta.on_the_line(-700).derivative, 2, 1e-12);
    EXPECT_NEAR(beta.on_the_line(700).derivative, -3, 1e-12);
}

TEST(PriorDensities, HaveTheirQuantilesOnTheLine) {
    for (const Prior& prior : priors()) {
        const PriorDensity density(prior);
        for (const double p : {1e-3, 0.2, 0.7, 0.999})
            EXPECT_NEAR(
                prior.cdf(density.transform().at(density.quantile_on_the_line(p)).x), p,
                1e-9)
                << words(prior);
        EXPECT_TRUE(std::isfinite(density.quantile_on_the_line(1e-17))) << words(prior);
        EXPECT_TRUE(std::isfinite(density.quantile_on_the_line(1))) << words(prior);
    }
}

// 1 - t = (1 - p)^10, so far from 1 as no double near 1 can be.
TEST(PriorDensities, HaveQuantilesCloserToAnEndThanDoublesAre) {
    const PriorDensity beta(Prior{PriorKind::beta, 1, 0.1, 0, 1});
    EXPECT_NEAR(beta.quantile_on_the_line(0.99), 10 * std::log(100), 1e-9);
}

TEST(FixedPriors, HaveOneValue) {
    const Prior fixed{PriorKind::fixed, 3};
    EXPECT_EQ(fixed.mean(), 3);
    EXPECT_EQ(fixed.sd(), 0);
    EXPECT_EQ(fixed.quantile(0.1), 3);
    EXPECT_EQ(fixed.log_density(3), 0);
    EXPECT_EQ(fixed.log_density(3.1), -infinity);
    EXPECT_EQ(fixed.cdf(2.9), 0);
    EXPECT_EQ(fixed.cdf(3), 1);
    EXPECT_EQ(transform_of(fixed).at(17).x, 3);
}

TEST(PriorComplaints, AreNoneForPriorsThatWork) {
    for (const Prior& prior : ordinary_priors()) EXPECT_EQ(complaint_about(prior), "");
    EXPECT_EQ(complaint_about({PriorKind::fixed, 3}), "");
}

TEST(PriorComplaints, SayWhatIsWrong) {
    const std::vector<std::pair<Prior, std::string>> table{
        {{PriorKind::normal, 500, 1, 0, 20},
         "normal(500, 1) has a mass of 0 between 0 and 20"},
        {{PriorKind::normal, 7, 1, -infinity, 0},
         "normal(7, 1) has a mass of 1.3e-12 between -inf and 0"},
        {{PriorKind::gamma, 3, 2, -5, -1},
         "gamma(3, 2) has a mass of 0 between -5 and -1"},
        {{PriorKind::normal, 5, 0.2, 10, 50, true},
         "normal(5, 0.2) of the range's share has a mass of 2.8e-89 between 10 and 50"},
        {{PriorKind::normal, 1, 0},
         "normal(1, 0): the standard deviation 0 must be above 0"},
        {{PriorKind::lognormal, 1, -2},
         "lognormal(1, -2): the standard deviation -2 must be above 0"},
        {{PriorKind::uniform, 0, 1, 3, 3},
         "uniform(3, 3): its range from 3 to 3 is empty"},
        {{PriorKind::normal, 0, 1, 5, -5},
         "normal(0, 1): its range from 5 to -5 is empty"},
        {{PriorKind::uniform, 0, 1, 0},
         "uniform(0, inf): needs a finite range, not 0 to inf"},
        {{PriorKind::normal, 0.5, 0.2, 0, infinity, true},
         "normal(0.5, 0.2) of the range's share: needs a finite range, not 0 to inf"},
        {{PriorKind::beta, 0, 1, 0, 1}, "beta(0, 1): both exponents must be above 0"},
        {{PriorKind::gamma, 1, -1}, "gamma(1, -1): shape and rate must be above 0"},
        {{PriorKind::normal, nan, 1}, "normal(nan, 1): its numbers must be finite"},
        {{PriorKind::uniform, 0, 1, nan, 1},
         "uniform(nan, 1): an end of its range is not a number"},
        {{PriorKind::fixed, 5, 1, 0, 3}, "fixed(5): lies outside its range from 0 to 3"}};
    for (const auto& [prior, words] : table) EXPECT_EQ(complaint_about(prior), words);
}

TEST(Prior, AreMadeByTheirNumbers) {
    EXPECT_EQ(fixed_prior(3).quantile(0.2), 3);
    EXPECT_DOUBLE_EQ(uniform_prior(2, 6).quantile(0.25), 3);
    EXPECT_DOUBLE_EQ(normal_prior(5, 2).mean(), 5);
    EXPECT_DOUBLE_EQ(normal_prior(5, 2).sd(), 2);
    EXPECT_NEAR(lognormal_prior(3, 0.7).quantile(0.5), 3, 1e-12);
    EXPECT_GT(lognormal_prior(3, 0.7, 1).quantile(0), 0.99);
}

}  // namespace
}  // namespace bemcal::stats
