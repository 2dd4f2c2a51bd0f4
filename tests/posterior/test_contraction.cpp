#include "posterior/contraction.hpp"
#include "stats/distributions.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using stats::normal_quantile;
using stats::PriorKind;

Coordinate normal(const std::string& name) {
    return {name, "1/h", {PriorKind::normal, 10, 2}};
}

Coordinate uniform(const std::string& name) {
    return {name, "W/m2", {PriorKind::uniform, 0, 1, 0, 20}};
}

constexpr std::size_t n_draws = 2000;

/// Draws at evenly spread probabilities p in (0, 1). \param columns  each a function of p
Matrix draws_of(const std::vector<std::function<double(double)>>& columns) {
    Matrix draws(n_draws, columns.size());
    for (std::size_t d = 0; d < n_draws; ++d)
        for (std::size_t c = 0; c < columns.size(); ++c)
            draws(d, c) = columns[c]((static_cast<double>(d) + 0.5) / n_draws);
    return draws;
}

/// A standard normal, by symmetry about p = 1/2 uncorrelated with normal_quantile(p).
double even_z(double p) {
    return normal_quantile(p < 0.5 ? 2 * p : 2 * (1 - p));
}

posterior::ParameterMove move_of(const Coordinate& coordinate,
                                 const std::function<double(double)>& draw) {
    return posterior::moves_of({coordinate}, draws_of({draw}))[0];
}

// The posterior N(13, 1) of a prior N(10, 2): variances 1 and 4.
TEST(ParameterMoves, AreThoseOfTwoNormals) {
    const posterior::ParameterMove move =
        move_of(normal("n"), [](double p) { return 13 + normal_quantile(p); });
    EXPECT_EQ(move.prior_mean, 10);
    EXPECT_EQ(move.prior_sd, 2);
    EXPECT_NEAR(move.posterior_mean, 13, 1e-9);
    EXPECT_NEAR(move.posterior_sd, 1, 2e-3);
    EXPECT_NEAR(move.contraction, 0.75, 1e-3);
    EXPECT_NEAR(move.shift, 1.5, 1e-9);
    EXPECT_NEAR(move.range_share, 0.5, 2e-3);
    EXPECT_TRUE(std::isnan(move.correlation));
    EXPECT_EQ(move.finding, posterior::Finding::narrowed);
    EXPECT_EQ(move.words, "the data narrow it: 50 % of the prior's spread is left");
}

TEST(ParameterMoves, SayThatTheDataDetermineIt) {
    const posterior::ParameterMove move =
        move_of(normal("n"), [](double p) { return 11 + 0.1 * normal_quantile(p); });
    EXPECT_EQ(move.finding, posterior::Finding::determined);
    EXPECT_EQ(move.words, "the data determine it: 5 % of the prior's spread is left");
}

TEST(ParameterMoves, SayThatTheDataSayNothing) {
    const posterior::ParameterMove of_normal =
        move_of(normal("n"), [](double p) { return 10 + 2 * normal_quantile(p); });
    const posterior::ParameterMove of_uniform =
        move_of(uniform("u"), [](double p) { return 20 * p; });
    for (const posterior::ParameterMove& move : {of_normal, of_uniform}) {
        EXPECT_EQ(move.finding, posterior::Finding::as_before);
        EXPECT_EQ(move.words, "as believed before: the data say nothing");
        EXPECT_NEAR(move.contraction, 0, 5e-3);
    }
}

TEST(ParameterMoves, SayThatItMovedWithoutBecomingNarrower) {
    const posterior::ParameterMove move =
        move_of(normal("n"), [](double p) { return 13 + 2 * normal_quantile(p); });
    EXPECT_EQ(move.finding, posterior::Finding::moved);
    EXPECT_EQ(move.words,
              "moved by +1.5 of the prior's spread, but as uncertain as before");
}

TEST(ParameterMoves, SayThatItIsWiderThanBelieved) {
    const posterior::ParameterMove move =
        move_of(normal("n"), [](double p) { return 10 + 3 * normal_quantile(p); });
    EXPECT_EQ(move.finding, posterior::Finding::wider);
    EXPECT_NE(move.words.find("150 % of the prior's spread"), std::string::npos);
}

TEST(ParameterMoves, SayWhichParameterItCannotBeToldApartFrom) {
    // the correlation of a and -a + 0.4 times another is -1 / sqrt(1.16)
    const auto a = [](double p) { return normal_quantile(p); };
    const auto b = [&](double p) { return -a(p) + 0.4 * even_z(p); };
    const Matrix draws = draws_of({[&](double p) { return 10 + a(p); },
                                   [&](double p) { return 10 + b(p); },
                                   [](double p) { return 10 + even_z(p); }});
    const auto moves = posterior::moves_of(
        {normal("air change"), normal("U-value"), normal("g")}, draws);
    EXPECT_EQ(moves[0].finding, posterior::Finding::confounded);
    EXPECT_EQ(moves[0].partner, "U-value");
    EXPECT_NEAR(moves[0].correlation, -1 / std::sqrt(1.16), 0.02);
    EXPECT_EQ(moves[0].words,
              "the data cannot tell it apart from U-value (correlation -0.93)");
    EXPECT_EQ(moves[1].partner, "air change");
    EXPECT_EQ(moves[2].finding, posterior::Finding::narrowed);
}

TEST(ParameterMoves, SayAtWhichEndOfItsRangeItIs) {
    const posterior::ParameterMove upper =
        move_of(uniform("u"), [](double p) { return 20 - 1.5 * p; });  // 2/3 above 19
    EXPECT_EQ(upper.finding, posterior::Finding::at_edge);
    EXPECT_EQ(
        upper.words,
        "at the upper end of its range (67 % of the draws are near 20): the range is "
        "too narrow, or it makes up for what the model lacks");
    const posterior::ParameterMove lower =
        move_of(uniform("u"), [](double p) { return 1.2 * p; });
    EXPECT_EQ(lower.finding, posterior::Finding::at_edge);
    EXPECT_NE(lower.words.find("lower end"), std::string::npos);
}

TEST(ParameterMoves, AreNotAtAnEdgeWhereThePriorWasSoBefore) {
    const stats::Prior prior{PriorKind::gamma, 0.1, 1, 0, 20};
    EXPECT_GT(prior.cdf(1), 0.9);
    const posterior::ParameterMove move =
        move_of({"g", "", prior}, [&prior](double p) { return prior.quantile(p); });
    EXPECT_EQ(move.finding, posterior::Finding::as_before);
}

TEST(ParameterMoves, OfAnOpenRangeHaveNoEdge) {
    const posterior::ParameterMove move =
        move_of(normal("n"), [](double p) { return 30 + 0.1 * normal_quantile(p); });
    EXPECT_EQ(move.finding, posterior::Finding::determined);
    EXPECT_NEAR(move.shift, 10, 1e-6);
}

// Values 1, 2, 3 alike: mean 2, variance 2/3.
TEST(ParameterMoves, OfADiscreteParameterStartFromItsValues) {
    const Coordinate discrete{"glazing", "", {}, {3, 1, 2}};
    const posterior::ParameterMove as_before =
        move_of(discrete, [](double p) { return 1 + std::floor(3 * p); });
    EXPECT_DOUBLE_EQ(as_before.prior_mean, 2);
    EXPECT_NEAR(as_before.prior_sd, std::sqrt(2.0 / 3), 1e-12);
    EXPECT_EQ(as_before.finding, posterior::Finding::as_before);
    const posterior::ParameterMove known = move_of(discrete, [](double) { return 3; });
    EXPECT_EQ(known.contraction, 1);
    EXPECT_EQ(known.finding, posterior::Finding::determined);
}

TEST(ParameterMoves, AreUnknownOfTooFewDraws) {
    for (const std::size_t n : {0U, 1U}) {
        const posterior::ParameterMove move =
            posterior::moves_of({normal("n")}, Matrix(n, 1, 3.0))[0];
        EXPECT_EQ(move.finding, posterior::Finding::unknown);
        EXPECT_EQ(move.words, "too few draws to tell");
        EXPECT_EQ(move.prior_mean, 10);
    }
}

TEST(ParameterMoves, OfFixedParametersAreNone) {
    const Coordinate fixed{"f", "", {PriorKind::fixed, 3}}, single{"s", "", {}, {7}};
    const Matrix draws = draws_of({[](double) { return 3; }, [](double) { return 7; },
                                   [](double p) { return 20 * p; }});
    const auto moves = posterior::moves_of({fixed, single, uniform("u")}, draws);
    EXPECT_EQ(moves[0].finding, posterior::Finding::fixed);
    EXPECT_EQ(moves[0].words, "fixed");
    EXPECT_TRUE(std::isnan(moves[0].contraction));
    EXPECT_EQ(moves[1].posterior_mean, 7);
    EXPECT_TRUE(std::isnan(moves[2].correlation));
    EXPECT_EQ(moves[2].partner, "");
}

}  // namespace
}  // namespace bemcal::study
