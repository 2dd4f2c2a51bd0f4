#include "base/random.hpp"
#include "stats/least_squares.hpp"

#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::stats;

namespace {

/// Readings of a line in three unknowns, in blocks of ten, some left out.
struct Line {
    Matrix derivatives{3, 60};
    std::vector<double> r, weights;
    std::vector<int> block;
    std::vector<double> prior = {1, 0, 1};
    std::vector<char> none = {0, 0, 0};

    Line() {
        Stream random(4, 0, 0);
        for (std::size_t k = 0; k < 60; ++k) {
            const double t = static_cast<double>(k) / 60;
            derivatives(0, k) = 1;
            derivatives(1, k) = t;
            derivatives(2, k) = std::sin(9 * t);
            r.push_back(0.4 - 2 * t + random.uniform());
            weights.push_back(k % 7 == 3 ? 0 : 0.5 + random.uniform());
            block.push_back(static_cast<int>(k / 10));
        }
    }

    std::vector<double> fitted(const std::vector<double>& by) const {
        const auto sums = normal_equations(derivatives, r, by);
        return solve(sums.matrix, prior, sums.right, none);
    }
    double left(std::size_t k, const std::vector<double>& d) const {
        double value = r[k];
        for (std::size_t j = 0; j < 3; ++j) value -= d[j] * derivatives(j, k);
        return value;
    }
};

}  // namespace

TEST(LeastSquares, SolutionBalancesTheResidualWithThePrior) {
    const Line line;
    const auto d = line.fitted(line.weights);
    for (std::size_t j = 0; j < 3; ++j) {
        double gradient = -line.prior[j] * d[j];
        for (std::size_t k = 0; k < 60; ++k)
            gradient += line.weights[k] * line.derivatives(j, k) * line.left(k, d);
        EXPECT_NEAR(gradient, 0, 1e-11);
    }
}

TEST(LeastSquares, JackknifeIsThatOfFitsToTheOtherBlocks) {
    const Line line;
    // Moved to the fit, where the prior pulls towards 0 from d: take the prior's centre
    // there by leaving it flat.
    Line at_fit = line;
    at_fit.prior = {0, 0, 0};
    const auto d = at_fit.fitted(line.weights);
    for (std::size_t k = 0; k < 60; ++k) at_fit.r[k] = line.left(k, d);
    std::vector<std::vector<double>> moves;
    for (int block = 0; block < 6; ++block) {
        auto weights = at_fit.weights;
        for (std::size_t k = 0; k < 60; ++k)
            if (at_fit.block[k] == block) weights[k] = 0;
        moves.push_back(at_fit.fitted(weights));
    }
    const auto deviations =
        jackknife_deviations(at_fit.derivatives, at_fit.r, at_fit.weights, at_fit.block,
                             at_fit.prior, at_fit.none);
    for (std::size_t k = 0; k < 3; ++k) {
        double mean = 0, square = 0;
        for (const auto& move : moves) mean += move[k] / 6;
        for (const auto& move : moves) square += (move[k] - mean) * (move[k] - mean);
        EXPECT_NEAR(deviations[k], std::sqrt(square * 5 / 6), 1e-10);
    }
}

TEST(LeastSquares, JackknifeOfAMeanIsItsStandardError) {
    // Of single readings it is the textbook's s / sqrt(n) (Efron 1982, chapter 3).
    const std::vector<double> readings = {3, 1, 4, 1, 5, 9, 2, 6};
    Matrix ones(1, 8);
    std::vector<double> r, weights(8, 1.0);
    std::vector<int> block;
    for (std::size_t k = 0; k < 8; ++k) {
        ones(0, k) = 1;
        r.push_back(readings[k] - 31.0 / 8);
        block.push_back(static_cast<int>(k));
    }
    double square = 0;
    for (const double one : r) square += one * one;
    const std::vector<double> flat = {0};
    const std::vector<char> free = {0};
    EXPECT_NEAR(jackknife_deviations(ones, r, weights, block, flat, free)[0],
                std::sqrt(square / 7 / 8), 1e-12);
}

TEST(LeastSquares, FixedUnknownsStay) {
    const Line line;
    const auto sums = normal_equations(line.derivatives, line.r, line.weights);
    const std::vector<char> fixed = {0, 1, 0};
    EXPECT_EQ(solve(sums.matrix, line.prior, sums.right, fixed)[1], 0);
    EXPECT_EQ(inverse(sums.matrix, line.prior, fixed)(1, 1), 0);
}

TEST(LeastSquares, BorderIsARowOfTheNormalEquations) {
    const Line line;
    const auto sums = normal_equations(line.derivatives, line.r, line.weights);
    const auto border =
        bordered(line.derivatives, line.derivatives.row(2), line.r, line.weights);
    for (std::size_t j = 0; j < 3; ++j)
        EXPECT_NEAR(border.with_others[j], sums.matrix(2, j), 1e-12);
    EXPECT_NEAR(border.with_itself, sums.matrix(2, 2), 1e-12);
    EXPECT_NEAR(border.with_residual, sums.right[2], 1e-12);
}

TEST(LeastSquares, BordersAreThoseOfEach) {
    const Line line;
    const Borders borders(line.derivatives, line.r, line.weights);
    const auto all =
        borders.of({line.derivatives.row(2).data(), line.derivatives.row(0).data()});
    for (std::size_t k = 0; k < 2; ++k) {
        const auto one = bordered(line.derivatives, line.derivatives.row(2 - 2 * k),
                                  line.r, line.weights);
        for (std::size_t j = 0; j < 3; ++j)
            EXPECT_NEAR(all[k].with_others[j], one.with_others[j], 1e-12);
        EXPECT_NEAR(all[k].with_itself, one.with_itself, 1e-12);
        EXPECT_NEAR(all[k].with_residual, one.with_residual, 1e-12);
    }
}
