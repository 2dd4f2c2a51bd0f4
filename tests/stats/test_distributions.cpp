#include "stats/distributions.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

void expect_close(double found, double expected, double relative = 1e-12) {
    EXPECT_NEAR(found, expected, relative * std::abs(expected));
}

// The numbers are scipy 1.10's (norm, beta, gamma, lognorm, t, f).
TEST(Distributions, AgreeWithScipy) {
    expect_close(normal_cdf(1.96), 0.9750021048517795);
    expect_close(normal_quantile(1e-10), -6.361340902404056);
    const Distribution beta{Family::beta, 2, 5};
    expect_close(beta.cdf(0.3), 0.579825);
    expect_close(beta.density(0.3), 2.1609);
    expect_close(beta.quantile(0.9), 0.5103163065514917);
    const Distribution gamma{Family::gamma, 3, 2};
    expect_close(gamma.cdf(1), 0.32332358381693654);
    expect_close(gamma.quantile(0.1), 0.5510326641246607);
    const Distribution lognormal{Family::lognormal, 0.2, 0.5};
    expect_close(lognormal.cdf(1), 0.3445782583896758);
    expect_close(lognormal.density(1), 0.7365402806066467);
    expect_close(lognormal.quantile(0.75), 1.7112855558277837);
    const Distribution student{Family::student_t, 3.5};
    expect_close(student.cdf(-2), 0.06306926128795674);
    expect_close(student.quantile(0.975), 2.9400886379827775);
    expect_close(student.density(1), 0.2112039436178112);
}

TEST(Distributions, NormalQuantilesThatWichuraPublished) {
    // Applied Statistics 37(3), p. 482: test values of PPND16.
    EXPECT_NEAR(normal_quantile(0.25), -0.6744897501960817, 1e-15);
    EXPECT_NEAR(normal_quantile(0.001), -3.090232306167814, 1e-14);
    EXPECT_NEAR(normal_quantile(1e-20), -9.262340089798408, 1e-14);
    EXPECT_EQ(normal_quantile(0.5), 0);
}

TEST(Distributions, NormalQuantileInvertsTheDistributionFunction) {
    for (double z = -8; z <= 5; z += 0.37)
        EXPECT_NEAR(normal_quantile(0.5 * std::erfc(-z / std::sqrt(2))), z,
                    z < 2 ? 1e-13 : 1e-9)
            << z;
}

TEST(Distributions, KeepTheirDigitsInTheUpperTail) {
    expect_close((Distribution{Family::normal, 0, 1}.upper_quantile(1e-20)),
                 9.262340089798409);
    expect_close((Distribution{Family::gamma, 3, 2}.upper(20)), 3.572865928700233e-15);
}

TEST(Distributions, HaveTheMomentsOfTheBooks) {
    const Distribution beta{Family::beta, 2, 5}, gamma{Family::gamma, 3, 2};
    const Distribution lognormal{Family::lognormal, 0.2, 0.5};
    expect_close(beta.mean(), 2.0 / 7);
    expect_close(beta.sd(), std::sqrt(10.0 / (49 * 8)));
    expect_close(gamma.mean(), 1.5);
    expect_close(gamma.sd(), std::sqrt(3) / 2);
    expect_close(lognormal.mean(), std::exp(0.2 + 0.125));
    expect_close(lognormal.sd(), std::exp(0.325) * std::sqrt(std::expm1(0.25)));
}

TEST(Distributions, EndWithTheirSupport) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Family family : {Family::normal, Family::lognormal, Family::beta,
                                Family::gamma, Family::student_t}) {
        const Distribution d{family, 2, 3};
        EXPECT_EQ(d.cdf(-infinity), 0);
        EXPECT_EQ(d.cdf(infinity), 1);
        EXPECT_EQ(d.upper(infinity), 0);
        EXPECT_EQ(d.density(infinity), 0);
        EXPECT_EQ(d.quantile(0), d.least());
        EXPECT_EQ(d.quantile(1), d.most());
        EXPECT_EQ(d.upper_quantile(0), d.most());
    }
}

TEST(Distributions, AreNotANumberWhereTheyAreNotDefined) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(Distribution({Family::normal, 0, -1}).cdf(0.5)));
    EXPECT_TRUE(std::isnan(Distribution({Family::beta, -1, 1}).quantile(0.5)));
    EXPECT_TRUE(std::isnan(Distribution({Family::gamma, 1, 1}).cdf(nan)));
    EXPECT_TRUE(std::isnan(normal_quantile(1.5)));
}

TEST(LogGamma, IsTheLogarithmOfTheFactorial) {
    expect_close(log_gamma(11), std::log(3628800));
    expect_close(log_gamma(0.5), std::log(std::sqrt(std::acos(-1.0))));
}

}  // namespace
}  // namespace bemcal::stats
