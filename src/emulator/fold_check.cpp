/// Principal components without a fold of the runs, in inner products of runs alone, and
/// the scores of that fold.
/// Source: kernel principal components (Schoelkopf, Smola and Mueller 1998, appendix) for
/// a point beside those that were learned from. Left out: scales are not learned again.
#include "emulator/fold_check.hpp"

#include "emulator/eigen_views.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace bemcal::emulator {
namespace {

constexpr std::size_t n_folds = 5;
/// Fewer runs than this left leave no components that could be compared.
constexpr std::size_t least_runs_for_folds = 10;

struct Fold {
    std::vector<Eigen::Index> kept, left;
};

/// Run i is in fold i modulo n_folds.
Fold fold_of(std::size_t number, std::size_t runs) {
    Fold made;
    for (std::size_t i = 0; i < runs; ++i)
        (i % n_folds == number ? made.left : made.kept).push_back(eigen_index(i));
    return made;
}

struct FoldScores {
    Eigen::MatrixXd kept, left;  ///< [components x runs]
};

/// As series_components.cpp has them, of the kept runs.
FoldScores scores_of(const Eigen::MatrixXd& gram, const Fold& fold, Eigen::Index most) {
    const Eigen::MatrixXd inner = gram(fold.kept, fold.kept);
    const Eigen::RowVectorXd means = inner.colwise().mean();
    const auto centred = [&](Eigen::MatrixXd rows) {  // [. x kept] less the kept's mean
        const Eigen::VectorXd of_rows = rows.rowwise().mean();
        rows.rowwise() -= means;
        rows.colwise() -= of_rows;
        rows.array() += means.mean();
        return rows;
    };
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred(inner));
    const Eigen::Index n = std::min(most, inner.rows() - 1);
    const Eigen::MatrixXd directions =
        solver.eigenvectors().rightCols(n).rowwise().reverse();
    const Eigen::VectorXd deviations =
        solver.eigenvalues()
            .tail(n)
            .reverse()
            .cwiseMax(1e-12 * solver.eigenvalues().maxCoeff())
            .cwiseSqrt();
    return {deviations.asDiagonal() * directions.transpose(),
            deviations.cwiseInverse().asDiagonal() * directions.transpose() *
                centred(gram(fold.left, fold.kept)).transpose()};
}

Matrix rows_at(const Matrix& points, const std::vector<Eigen::Index>& rows) {
    Matrix made(rows.size(), points.cols);
    for (std::size_t i = 0; i < rows.size(); ++i)
        std::ranges::copy(points.row(static_cast<std::size_t>(rows[i])),
                          made.row(i).begin());
    return made;
}

}  // namespace

std::vector<double> variance_factors(const Matrix& points, const Matrix& gram,
                                     std::span<const ScoreScales> scales) {
    std::vector<double> squares(scales.size()), variances(scales.size());
    if (points.rows < least_runs_for_folds)
        return std::vector<double>(scales.size(), 1.0);
    const Eigen::MatrixXd inner = eigen_view(gram);
    for (std::size_t number = 0; number < n_folds; ++number) {
        const Fold fold = fold_of(number, points.rows);
        const Matrix kept = rows_at(points, fold.kept), left = rows_at(points, fold.left);
        const FoldScores scores = scores_of(inner, fold, eigen_index(scales.size()));
        for (Eigen::Index c = 0; c < scores.kept.rows(); ++c) {
            const auto score = static_cast<std::size_t>(c);
            const Eigen::VectorXd learned = scores.kept.row(c);
            const ScoreProcess process(kept, {learned.data(), kept.rows}, scales[score]);
            for (std::size_t i = 0; i < left.rows; ++i) {
                const double error =
                    scores.left(c, eigen_index(i)) - process.mean(left.row(i));
                squares[score] += error * error;
                variances[score] += process.variance(left.row(i));
            }
        }
    }
    std::vector<double> factors(scales.size(), 1.0);
    for (std::size_t c = 0; c < scales.size(); ++c)
        if (variances[c] > 0) factors[c] = std::max(1.0, squares[c] / variances[c]);
    return factors;
}

}  // namespace bemcal::emulator
