/// Principal components by the eigenvectors of the Gram matrix, runs times runs.
/// Source: Jolliffe 2002, 3.5, as a singular value decomposition; of simulators' outputs:
/// Higdon, Gattiker, Williams and Rightley 2008. Components whose share of the variance
/// is below 1e-12 or so would be rounding; far fewer are kept.
#include "emulator/series_components.hpp"

#include "emulator/eigen_views.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace bemcal::emulator {
namespace {

/// A spread of 1e-12 of the series themselves, squared, is rounding: they are all the
/// same.
constexpr double share_of_rounding = 1e-24;
/// Columns that are weighted at once, so that the series are not copied as a whole.
constexpr Eigen::Index columns_at_once = 1024;

/// Takes the runs' mean off them.
std::vector<double> centre(Matrix& series) {
    const auto runs = eigen_view(series);
    const Eigen::RowVectorXd mean = runs.colwise().mean();
    eigen_view(series).rowwise() -= mean;
    return {mean.begin(), mean.end()};
}

/// Of the centred, weighted runs. [runs x runs]
Eigen::MatrixXd gram_matrix(const Matrix& centred, std::span<const double> weights) {
    const auto runs = eigen_view(centred);
    const auto weight = eigen_view(weights);
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(runs.rows(), runs.rows());
    for (Eigen::Index first = 0; first < runs.cols(); first += columns_at_once) {
        const Eigen::Index size = std::min(columns_at_once, runs.cols() - first);
        const Eigen::MatrixXd weighted =
            runs.middleCols(first, size) * weight.segment(first, size).asDiagonal();
        gram.selfadjointView<Eigen::Lower>().rankUpdate(weighted);
    }
    return gram.selfadjointView<Eigen::Lower>();
}

/// How many of the rising eigenvalues carry the share that is kept.
Eigen::Index n_kept(const Eigen::VectorXd& variances, double square_of_mean,
                    double share) {
    const double total = variances.cwiseMax(0).sum();
    if (total <= share_of_rounding * square_of_mean) return 0;
    double carried = 0;
    Eigen::Index kept = 0;
    while (kept < variances.size() && carried < share * total)
        carried += variances[variances.size() - ++kept];
    return kept;
}

}  // namespace

SeriesComponents components_of(Matrix series, std::span<const double> weights,
                               double share) {
    SeriesComponents made;
    made.mean = centre(series);
    const Eigen::MatrixXd gram = gram_matrix(series, weights);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    made.gram = Matrix(series.rows, series.rows);
    eigen_view(made.gram) = gram;
    const double square_of_mean =
        eigen_view(weights)
            .cwiseProduct(eigen_view(std::span<const double>(made.mean)))
            .squaredNorm();
    const Eigen::Index kept = n_kept(solver.eigenvalues(), square_of_mean, share);
    const Eigen::VectorXd deviations =
        solver.eigenvalues().tail(kept).reverse().cwiseSqrt();
    const Eigen::MatrixXd directions =
        solver.eigenvectors().rightCols(kept).rowwise().reverse();
    made.components = Matrix(static_cast<std::size_t>(kept), series.cols);
    made.scores = Matrix(static_cast<std::size_t>(kept), series.rows);
    eigen_view(made.scores) = deviations.asDiagonal() * directions.transpose();
    auto components = eigen_view(made.components);
    components.noalias() = directions.transpose() * eigen_view(series);
    components = deviations.cwiseInverse().asDiagonal() * components;
    eigen_view(series).noalias() -= eigen_view(made.scores).transpose() * components;
    made.remainder = std::move(series);
    return made;
}

}  // namespace bemcal::emulator
