/// Normal points by quantiles of a Sobol sequence.
/// Source: Joe and Kuo 2008 for the sequence. What lies beyond a bound is put on it, so
/// bounds get more than their share; the normal is not truncated otherwise.
#include "emulator/spread_points.hpp"

#include "emulator/eigen_views.hpp"
#include "stats/distributions.hpp"
#include "stats/sobol_sequence.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

namespace bemcal::emulator {
namespace {

constexpr std::uint64_t scramble = 1;  ///< any: it is the same for all
/// Half of a step of the sequence's numbers, so that 0 has a quantile.
constexpr double half_a_step = 0x1p-33;

}  // namespace

Matrix spread_points(std::span<const double> centre, const Matrix& covariance,
                     std::size_t n) {
    Matrix points =
        stats::scrambled_sobol_points(0, n, static_cast<int>(centre.size()), scramble);
    const Eigen::LLT<Eigen::MatrixXd> factor(eigen_view(covariance));
    for (std::size_t i = 0; i < n; ++i) {
        for (double& u : points.row(i)) u = stats::normal_quantile(u + half_a_step);
        auto point = eigen_view(points.row(i));
        point = eigen_view(centre) + factor.matrixL() * Eigen::VectorXd(point);
        point = point.cwiseMax(0).cwiseMin(1);
    }
    return points;
}

}  // namespace bemcal::emulator
