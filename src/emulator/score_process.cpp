/// What a score's process says at a point, from a Cholesky factor of its runs'
/// covariance.
/// Sources: Rasmussen and Williams 2006, eq. 2.41-2.42 with a constant as the basis;
/// Dubrule 1983 for leaving out. Left out: the uncertainty of the scales.
#include "emulator/score_process.hpp"

#include "emulator/eigen_views.hpp"
#include "emulator/matern.hpp"

#include <algorithm>
#include <stdexcept>

#include <Eigen/Cholesky>

namespace bemcal::emulator {
namespace {

double scaled_square(std::span<const double> a, std::span<const double> b,
                     const ScoreScales& scales) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const double distance = (a[k] - b[k]) / scales.lengths[k];
        sum += distance * distance;
    }
    return sum;
}

/// Of the slopes, from the middle of the parameters' range.
double product_from_middle(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - 0.5) * (b[k] - 0.5);
    return sum;
}

double covariance_between(std::span<const double> a, std::span<const double> b,
                          const ScoreScales& scales) {
    return matern_at(scaled_square(a, b, scales)).correlation +
           scales.slope_variance * product_from_middle(a, b);
}

/// Of scores that are nearly linear slopes vary so much more than the rest that rounding
/// takes up the nugget.
constexpr double more_nugget = 10;
constexpr int most_raises = 12;

}  // namespace

ScoreProcess::ScoreProcess(const Matrix& points, std::span<const double> scores,
                           const ScoreScales& scales)
    : points_(points),
      scales_(scales),
      factor_(points.rows, points.rows),
      whitened_one_(points.rows, 1.0),
      solved_(points.rows),
      left_precisions_(points.rows) {
    for (std::size_t i = 0; i < points.rows; ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            factor_(i, j) = covariance_between(points.row(i), points.row(j), scales);
    }
    const Eigen::Index n = eigen_index(points.rows);
    const Eigen::MatrixXd smooth = eigen_view(factor_);
    const auto with_nugget = [&] {
        return smooth + scales_.nugget * Eigen::MatrixXd::Identity(n, n);
    };
    Eigen::LLT<Eigen::MatrixXd> made(with_nugget());
    for (int k = 0; k < most_raises && made.info() != Eigen::Success; ++k) {
        scales_.nugget *= more_nugget;
        made.compute(with_nugget());
    }
    if (made.info() != Eigen::Success)
        throw std::domain_error("a score's covariance is not positive definite");
    eigen_view(factor_) = made.matrixL();
    auto one = eigen_view(std::span<double>(whitened_one_));
    made.matrixL().solveInPlace(one);
    const Eigen::VectorXd white = made.matrixL().solve(eigen_view(scores));
    constant_ = one.dot(white) / one.squaredNorm();
    const Eigen::VectorXd residual = white - constant_ * one;
    variance_ = residual.squaredNorm() / static_cast<double>(n - 1);
    eigen_view(std::span<double>(solved_)) = made.matrixU().solve(residual);
    const Eigen::MatrixXd inverse_factor =
        made.matrixL().solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::VectorXd of_one = inverse_factor.transpose() * one;
    eigen_view(std::span<double>(left_precisions_)) =
        inverse_factor.colwise().squaredNorm().transpose() -
        of_one.cwiseAbs2() / one.squaredNorm();
}

std::vector<double> ScoreProcess::covariances(std::span<const double> point) const {
    std::vector<double> made(points_.rows);
    for (std::size_t i = 0; i < points_.rows; ++i)
        made[i] = covariance_between(point, points_.row(i), scales_);
    return made;
}

double ScoreProcess::mean(std::span<const double> point) const {
    const std::vector<double> with_runs = covariances(point);
    return constant_ + eigen_view(std::span<const double>(with_runs))
                           .dot(eigen_view(std::span<const double>(solved_)));
}

std::vector<double> ScoreProcess::gradient(std::span<const double> point) const {
    std::vector<double> sums(point.size());
    for (std::size_t i = 0; i < points_.rows; ++i) {
        const auto run = points_.row(i);
        const double slope = matern_at(scaled_square(point, run, scales_)).slope;
        for (std::size_t k = 0; k < point.size(); ++k) {
            const double length = scales_.lengths[k];
            sums[k] += solved_[i] * (2 * slope * (point[k] - run[k]) / (length * length) +
                                     scales_.slope_variance * (run[k] - 0.5));
        }
    }
    return sums;
}

double ScoreProcess::variance(std::span<const double> point) const {
    std::vector<double> with_runs = covariances(point);
    auto white = eigen_view(std::span<double>(with_runs));
    eigen_view(factor_).triangularView<Eigen::Lower>().solveInPlace(white);
    const auto one = eigen_view(std::span<const double>(whitened_one_));
    const double of_constant = 1 - one.dot(white);
    const double left = covariance_between(point, point, scales_) - white.squaredNorm() +
                        of_constant * of_constant / one.squaredNorm();
    return variance_ * std::max(left, 0.0);  // below 0 it is rounding
}

std::vector<double> ScoreProcess::leave_one_out() const {
    std::vector<double> errors(points_.rows);
    for (std::size_t i = 0; i < points_.rows; ++i)
        errors[i] = solved_[i] / left_precisions_[i];
    return errors;
}

}  // namespace bemcal::emulator
