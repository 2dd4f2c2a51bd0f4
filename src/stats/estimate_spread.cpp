/// How far least-squares parameters may be off where residuals follow each other: a
/// sandwich with a first-order autoregression as its middle, beside flat ranges.
/// Source: White 1980 (the sandwich). Left out: curvature, correlation among series,
/// correlation beyond lag one; each series counts by its own variance.
#include "stats/estimate_spread.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace bemcal::stats {
namespace {

double mean_square(std::span<const double> residuals) {
    double sum = 0, n = 0;
    for (const double e : residuals)
        if (!std::isnan(e)) {
            sum += e * e;
            n += 1;
        }
    return n > 0 ? sum / n : 0;
}

/// S v of a first-order autoregression with unit variance: v taken with its followers
/// and its predecessors, each weighing rho to the power of its distance.
Eigen::VectorXd correlated(const Eigen::VectorXd& v, double rho) {
    Eigen::VectorXd sum = -v;
    double forward = 0, backward = 0;
    for (Eigen::Index i = 0, n = v.size(); i < n; ++i) {
        forward = v[i] + rho * forward;
        sum[i] += forward;
        backward = v[n - 1 - i] + rho * backward;
        sum[n - 1 - i] += backward;
    }
    return sum;
}

/// Steps without a reading count for nothing, but lie between their neighbours.
Eigen::MatrixXd jacobian_of(const ResidualSeries& series) {
    const auto n = static_cast<Eigen::Index>(series.residuals.size()),
               p = static_cast<Eigen::Index>(series.derivatives.rows);
    Eigen::MatrixXd jacobian(n, p);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index k = 0; k < p; ++k) {
            const auto row = static_cast<std::size_t>(k),
                       col = static_cast<std::size_t>(i);
            const bool is_read = !std::isnan(series.residuals[col]) &&
                                 std::isfinite(series.derivatives(row, col));
            jacobian(i, k) = is_read ? series.derivatives(row, col) : 0;
        }
    return jacobian;
}

/// Of the series weighted to unit variance.
struct Normal {
    Eigen::MatrixXd bread, meat;
};

void add(const ResidualSeries& series, Normal& normal) {
    const double variance = mean_square(series.residuals);
    if (!(variance > 0)) return;
    const double rho = lag_one_correlation(series.residuals);
    const Eigen::MatrixXd jacobian = jacobian_of(series) / std::sqrt(variance);
    normal.bread += jacobian.transpose() * jacobian;
    Eigen::MatrixXd spread(jacobian.rows(), jacobian.cols());
    for (Eigen::Index k = 0; k < jacobian.cols(); ++k)
        spread.col(k) = correlated(jacobian.col(k), rho);
    normal.meat += jacobian.transpose() * spread;
}

}  // namespace

double lag_one_correlation(std::span<const double> residuals) {
    double product = 0, square = 0;
    for (std::size_t i = 1; i < residuals.size(); ++i)
        if (!std::isnan(residuals[i - 1]) && !std::isnan(residuals[i])) {
            product += residuals[i - 1] * residuals[i];
            square +=
                (residuals[i - 1] * residuals[i - 1] + residuals[i] * residuals[i]) / 2;
        }
    return square > 0 ? std::clamp(product / square, 0.0, 0.999) : 0;
}

std::vector<double> estimate_spread(std::span<const ResidualSeries> series,
                                    std::size_t n_parameters) {
    const auto p = static_cast<Eigen::Index>(n_parameters);
    Normal normal{Eigen::MatrixXd::Zero(p, p), Eigen::MatrixXd::Zero(p, p)};
    for (const ResidualSeries& one : series) add(one, normal);
    // What the data say is bread meat^-1 bread; a ridge keeps an empty direction empty.
    const double ridge = 1e-12 * (1 + normal.meat.trace());
    const Eigen::MatrixXd meat = normal.meat + ridge * Eigen::MatrixXd::Identity(p, p);
    const Eigen::MatrixXd information = normal.bread * meat.ldlt().solve(normal.bread);
    const Eigen::MatrixXd covariance =
        (information + Eigen::MatrixXd::Identity(p, p) / flat_variance).inverse();
    std::vector<double> spread;
    spread.reserve(n_parameters);
    for (Eigen::Index k = 0; k < p; ++k)
        spread.push_back(std::sqrt(std::clamp(covariance(k, k), 0.0, flat_variance)));
    return spread;
}

}  // namespace bemcal::stats
