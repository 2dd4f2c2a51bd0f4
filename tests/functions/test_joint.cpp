/// The joint model against the Gaussian likelihood written out, and on made readings.
#include "base/random.hpp"
#include "functions/joint.hpp"
#include "stats/distributions.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::functions {
namespace {

constexpr long n_blocks = 24, per_block = 40, n_rows = n_blocks * per_block;

double normal(Stream& random) {
    return stats::normal_quantile(random.uniform());
}

/// Pair 0 follows hours, pair 1 something else, pair 2 nothing that is there.
Eigen::MatrixXf columns_of_pair(std::size_t id) {
    Eigen::MatrixXf columns(n_rows, 3);
    Stream random(7, 0, id);
    for (long k = 0; k < columns.size(); ++k)
        columns.data()[k] = static_cast<float>(normal(random));
    return columns;
}

/// White noise, and a function of pair `planted` (-1 = none) of coefficients `size`.
WeighedData data_with(int planted, double size, std::uint64_t seed,
                      double persistence = 0) {
    WeighedData data;
    for (long b = 0; b <= n_blocks; ++b) data.first_row.push_back(b * per_block);
    for (std::size_t b = 0; b < n_blocks; ++b) data.fold.push_back(b % 6);
    Stream random(seed, 0, 0);
    data.residual.resize(n_rows);
    double last = 0;
    for (long k = 0; k < n_rows; ++k) {
        last = persistence * last +
               std::sqrt(1 - persistence * persistence) * normal(random);
        data.residual[k] = static_cast<float>(last);
    }
    if (planted >= 0)
        data.residual += columns_of_pair(static_cast<std::size_t>(planted)) *
                         Eigen::VectorXf::Constant(3, static_cast<float>(size));
    data.left = data.residual;
    data.parameters = Eigen::MatrixXf::Ones(n_rows, 1);
    data.precision = Eigen::VectorXd::Constant(1, 1.0);
    data.at = Eigen::VectorXd::Zero(1);
    return data;
}

const std::vector<Pair> three{{0, 3}, {1, 3}, {2, 3}};

/// log N(r; 0, I + J J' + variance / scatter X X') by its definition; errors of variance
/// `scatter` count as ones of 1.
double log_likelihood(const WeighedData& data, const Eigen::MatrixXf& columns,
                      double variance, double scatter) {
    const Eigen::MatrixXd J = data.parameters.cast<double>(), X = columns.cast<double>();
    const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n_rows, n_rows) +
                                       J * J.transpose() +
                                       variance / scatter * X * X.transpose();
    const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
    const Eigen::VectorXd r = data.residual.cast<double>();
    double log_determinant = 0;
    for (long k = 0; k < n_rows; ++k)
        log_determinant += 2 * std::log(llt.matrixLLT()(k, k));
    return -0.5 * (r.dot(llt.solve(r)) + log_determinant);
}

}  // namespace

TEST(JointModel, FindsTheFunctionThatIsThereAndItsCoefficients) {
    const WeighedData data = data_with(1, 0.3, 1);
    const Path path = search_functions(data, three, columns_of_pair);
    ASSERT_EQ(path.stages.size(), 2u);
    const FunctionFit& found = path.stages[1].all.functions.at(0);
    EXPECT_EQ(found.id, 1u);
    for (const double coefficient : found.mean) EXPECT_NEAR(coefficient, 0.3, 0.1);
    EXPECT_NEAR(std::sqrt(found.variance), 0.3, 0.15);
}

/// Seeds are fixed. Evidence above the odds of 3 would be seen in under 1 of 20 draws.
TEST(JointModel, FindsNothingInNoise) {
    int n_found = 0;
    for (std::uint64_t seed = 10; seed < 30; ++seed)
        n_found += search_functions(data_with(-1, 0, seed), three, columns_of_pair)
                               .stages.size() > 1
                       ? 1
                       : 0;
    EXPECT_LE(n_found, 1);
}

TEST(JointModel, EvidenceIsThatOfTheLikelihoodWrittenOut) {
    const WeighedData data = data_with(1, 0.3, 1);
    const Path path = search_functions(data, {{1, 0}}, columns_of_pair);
    const FunctionFit& found = path.stages.at(1).all.functions.at(0);
    // Of the likelihood of r at scatter 1: the pair's own scatter divides A and z both.
    const double evidence =
        log_likelihood(data, columns_of_pair(1), found.variance, found.scatter) -
        log_likelihood(data, columns_of_pair(1), 0, 1);
    // (z / s)^2 v / (1 + A v / s) is 1 / s of the likelihood's at v / s.
    double log_determinant = 0;
    const Eigen::MatrixXd X = columns_of_pair(1).cast<double>(),
                          J = data.parameters.cast<double>();
    const Eigen::MatrixXd A =
        X.transpose() * X - X.transpose() * J * J.transpose() * X / (n_rows + 1.0);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
    for (const double d : solver.eigenvalues())
        log_determinant += std::log1p(d * found.variance / found.scatter);
    const double expected =
        (evidence + 0.5 * log_determinant) / found.scatter - 0.5 * log_determinant;
    EXPECT_NEAR(found.evidence, expected, 1e-3 * expected);
}

TEST(JointModel, CovarianceIsThatOfTheCoefficientsWithTheParametersFree) {
    const WeighedData data = data_with(1, 0.3, 1);
    const Path path = search_functions(data, {{1, 0}}, columns_of_pair);
    const FunctionFit& found = path.stages.at(1).all.functions.at(0);
    const Eigen::MatrixXd X = columns_of_pair(1).cast<double>(),
                          J = data.parameters.cast<double>();
    Eigen::MatrixXd precision =
        X.transpose() * X - X.transpose() * J * J.transpose() * X / (n_rows + 1.0);
    precision /= found.scatter;
    precision.diagonal().array() += 1 / found.variance;
    EXPECT_TRUE(
        (found.covariance * precision).isApprox(Eigen::MatrixXd::Identity(3, 3), 1e-4));
}

/// 300 coefficients at fixed seeds: a share of 0.90 +- 0.017, beyond these limits with a
/// chance of 1e-4.
TEST(JointModel, IntervalsHoldWhatIsThere) {
    int inside = 0;
    for (std::uint64_t seed = 100; seed < 200; ++seed) {
        const Path path =
            search_functions(data_with(1, 0.3, seed), {{1, 0}}, columns_of_pair);
        const FunctionFit& found = path.stages.at(1).all.functions.at(0);
        for (long k = 0; k < 3; ++k)
            if (std::abs(found.mean[k] - 0.3) <=
                1.645 * std::sqrt(found.covariance(k, k)))
                ++inside;
    }
    EXPECT_GE(inside, 250);
    EXPECT_LE(inside, 290);
}

// Ridge regression about where the parameter is: (n + prior + 1 / range^2)^-1 (sum r).
TEST(JointModel, ParametersMoveWithinTheirLinearRange) {
    WeighedData data = data_with(-1, 0, 3);
    data.residual.array() += 1;
    const double sum = data.residual.cast<double>().sum();
    for (const double range : {0.0, 0.2, 0.01}) {
        data.linear_range = range;
        const Path path = search_functions(data, {}, columns_of_pair);
        const double precision = n_rows + 1 + (range > 0 ? 1 / (range * range) : 0);
        EXPECT_NEAR(path.stages.at(0).all.parameters[0], sum / precision, 1e-6);
    }
}

TEST(JointModel, WhatIsThereIsEstimatedAgainAndOthersJoinIt) {
    WeighedData data = data_with(1, 0.3, 1);
    const Path alone = search_functions(data, {{1, 0}}, columns_of_pair);
    const FunctionFit& found = alone.stages.at(1).all.functions.at(0);
    data.residual += columns_of_pair(0) * Eigen::VectorXf::Constant(3, 0.2F);
    data.left = data.residual;
    const Path path = search_functions(data, three, columns_of_pair,
                                       {{1, found.variance, found.scatter}});
    ASSERT_EQ(path.stages.size(), 2u);
    ASSERT_EQ(path.stages[0].all.functions.size(), 1u);
    EXPECT_EQ(path.stages[0].all.functions[0].id, 1u);
    for (const double coefficient : path.stages[0].all.functions[0].mean)
        EXPECT_NEAR(coefficient, 0.3, 0.1);
    ASSERT_EQ(path.stages[1].all.functions.size(), 2u);
    EXPECT_EQ(path.stages[1].all.functions[1].id, 0u);
    for (const double coefficient : path.stages[1].all.functions[1].mean)
        EXPECT_NEAR(coefficient, 0.2, 0.1);
}

// What was there and brings nothing is next to nothing again, or leaves.
TEST(JointModel, WhatIsThereAndBringsNothingShrinks) {
    const Path path =
        search_functions(data_with(-1, 0, 11), {}, columns_of_pair, {{2, 4, 1}});
    for (const FunctionFit& left : path.stages.at(0).all.functions)
        EXPECT_LT(left.mean.norm(), 0.1);
}

TEST(JointModel, HalvesHaveNotSeenTheirFolds) {
    WeighedData data = data_with(1, 0.3, 1);
    const Path path = search_functions(data, {{1, 0}}, columns_of_pair);
    // What the first half has not seen may be anything: its fit stays.
    WeighedData other = data;
    for (std::size_t b = 0; b < n_blocks; ++b)
        if (other.fold[b] % 2 == 0)
            other.residual.segment(other.first_row[b], per_block) *= 1.02F;
    const Path changed = search_functions(other, {{1, 0}}, columns_of_pair);
    const auto& before = path.stages.at(1).halves[0].functions.at(0);
    const auto& after = changed.stages.at(1).halves[0].functions.at(0);
    // Only the variance, which all readings tell, moves it by a little.
    EXPECT_LT((before.mean - after.mean).norm(), 1e-3 * before.mean.norm());
    EXPECT_GT((path.stages.at(1).halves[1].functions.at(0).mean -
               changed.stages.at(1).halves[1].functions.at(0).mean)
                  .norm(),
              1e-2 * before.mean.norm());
}

}  // namespace bemcal::functions
