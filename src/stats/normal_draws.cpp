/// A square root of the covariance times standard normals.
/// Source: Golub and Van Loan 2013, 8.1, for the square root by eigenvectors.
#include "stats/normal_draws.hpp"

#include "base/random.hpp"
#include "stats/distributions.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace bemcal::stats {

Matrix normal_draws(const Matrix& covariance, std::size_t n, std::uint64_t seed) {
    const auto p = static_cast<long>(covariance.rows);
    const Eigen::Map<const Eigen::MatrixXd> given(covariance.values.data(), p, p);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(given);
    const Eigen::MatrixXd root =
        solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
    Stream stream(seed, 0, 0);
    Matrix draws(n + 1, covariance.cols);
    Eigen::VectorXd z(p);
    for (std::size_t r = 1; r <= n; ++r) {
        for (long k = 0; k < p; ++k) z[k] = normal_quantile(stream.uniform());
        const Eigen::VectorXd draw = root * z;
        std::copy(draw.begin(), draw.end(), draws.row(r).begin());
    }
    return draws;
}

}  // namespace bemcal::stats
