/// The readings' square in the scores, with the emulator's own variance in it.
/// Source: Woodbury's identity on a square root of B'B, which takes no difference of
/// large numbers: B' C^-1 B = R (1 + R' V R)^-1 R'.
#include "emulator/score_objective.hpp"

#include "emulator/eigen_views.hpp"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace bemcal::emulator {
namespace {

/// Directions of the scores with less than this share of the largest one's information
/// are rounding.
constexpr double least_information = 1e-13;
constexpr Eigen::Index numbers_at_once = 1024;  ///< as in series_components.cpp

}  // namespace

MeasuredScores::MeasuredScores(const SeriesEmulator& emulator,
                               std::span<const double> measured,
                               std::span<const double> weights) {
    const auto components = eigen_view(emulator.parts().components);
    const auto mean = eigen_view(std::span<const double>(emulator.parts().mean));
    const Eigen::Index n = mean.size(), k = components.rows();
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(k, k);
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(k);
    double square = 0;
    for (Eigen::Index first = 0; first < n; first += numbers_at_once) {
        const Eigen::Index size = std::min(numbers_at_once, n - first);
        const auto weight = eigen_view(weights).segment(first, size);
        const Eigen::VectorXd r =
            (weight.array() > 0)
                .select(weight.cwiseProduct(eigen_view(measured).segment(first, size) -
                                            mean.segment(first, size)),
                        0);
        const Eigen::MatrixXd B =
            components.middleCols(first, size) * weight.asDiagonal();
        information += B * B.transpose();
        pull += B * r;
        square += r.squaredNorm();
    }
    rest_ = square;
    root_ = Eigen::MatrixXd(k, 0);
    if (k == 0) return;  // all runs are the same
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
    const Eigen::VectorXd& values = solver.eigenvalues();
    Eigen::Index rank = 0;
    while (rank < k && values[k - 1 - rank] > 0 &&
           values[k - 1 - rank] > least_information * values[k - 1])
        ++rank;
    const Eigen::VectorXd roots = values.tail(rank).cwiseSqrt();
    root_ = solver.eigenvectors().rightCols(rank) * roots.asDiagonal();
    seen_ = roots.cwiseInverse().asDiagonal() *
            (solver.eigenvectors().rightCols(rank).transpose() * pull);
    rest_ = std::max(square - seen_.squaredNorm(), 0.0);
}

MeasuredScores::Square MeasuredScores::square(const Eigen::VectorXd& variance) const {
    Eigen::MatrixXd inner = root_.transpose() * variance.asDiagonal() * root_;
    inner.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> factor(inner);
    const Eigen::VectorXd solved = factor.solve(seen_);
    return {root_ * factor.solve(Eigen::MatrixXd(root_.transpose())), root_ * solved,
            rest_ + seen_.dot(solved)};
}

}  // namespace bemcal::emulator
