/// Priors as covariances between points of a driver (a Gaussian process on few points):
/// the columns are its principal components, each times its standard deviation.
/// Source: Wood 2017 (Generalized Additive Models), 5.4 and 5.6.3, for penalties as
/// priors and pure interactions; Rasmussen and Williams 2006, 4.2, for the covariances.
/// Length scales are judgement.
#include "functions/basis.hpp"

#include "functions/decisions.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace bemcal::functions {
namespace {

using Covariance = Eigen::MatrixXd;

double hours_apart(long a, long b) {
    const double d = std::abs(static_cast<double>(a % 24 - b % 24));
    return std::min(d, 24 - d);
}

/// Exponential: it lets edges be as sharp as an hour.
Covariance covariance_of_hours(long n_classes) {
    Covariance covariance(24 * n_classes, 24 * n_classes);
    for (long i = 0; i < covariance.rows(); ++i)
        for (long j = 0; j < covariance.cols(); ++j)
            covariance(i, j) = std::exp(-hours_apart(i, j) / decisions::hours_alike) *
                               (i / 24 == j / 24 ? 1 : decisions::share_of_all_days);
    return covariance;
}

/// Squared exponential: it bends slowly.
Covariance covariance_of_knots(long n) {
    Covariance covariance(n, n);
    for (long i = 0; i < n; ++i)
        for (long j = 0; j < n; ++j) {
            const double d = static_cast<double>(i - j) / decisions::knots_alike;
            covariance(i, j) = std::exp(-0.5 * d * d);
        }
    return covariance;
}

/// A random walk from 0.
Covariance covariance_of_walk(long n) {
    Covariance walk(n, n);
    for (long i = 0; i < n; ++i)
        for (long j = 0; j < n; ++j) walk(i, j) = static_cast<double>(std::min(i, j) + 1);
    return walk;
}

Covariance product(const Covariance& a, const Covariance& b) {
    Covariance all(a.rows() * b.rows(), a.cols() * b.cols());
    for (long i = 0; i < a.rows(); ++i)
        for (long j = 0; j < a.cols(); ++j)
            all.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
    return all;
}

/// [points] how often training is at each.
Eigen::VectorXd shares_of(const Points& points,
                          const std::vector<std::vector<double>>& drivers) {
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(static_cast<long>(points.size()));
    std::vector<double> at(drivers.size());
    for (std::size_t k = 0; k < drivers[0].size(); ++k) {
        for (std::size_t d = 0; d < at.size(); ++d) at[d] = drivers[d][k];
        const Points::Weights w = points.weights(at);
        for (std::size_t i = 0; i < w.point.size(); ++i)
            shares[static_cast<long>(w.point[i])] += w.weight[i];
    }
    return shares / static_cast<double>(drivers[0].size());
}

/// Takes off the weighted means along rows or columns of the points: their projection.
Eigen::MatrixXd centring(const Eigen::VectorXd& shares) {
    const long n = shares.size();
    return Eigen::MatrixXd::Identity(n, n) -
           Eigen::VectorXd::Ones(n) * shares.transpose();
}

/// Fills the columns: principal components of the prior after `off` has taken off what
/// other bases hold, scaled so that a function's mean square over training is 1.
void fill(Basis& basis, const Covariance& prior, const Eigen::MatrixXd& off,
          const Eigen::VectorXd& shares) {
    Covariance left = off * prior * off.transpose();
    const double mean_square = left.diagonal().dot(shares);
    if (mean_square > 1e-12) left /= mean_square;
    const Eigen::SelfAdjointEigenSolver<Covariance> solver(left);
    const double all = solver.eigenvalues().cwiseMax(0).sum();
    long n = 0;
    for (double sum = 0; n < left.rows() && sum < decisions::kept_variance * all; ++n)
        sum += solver.eigenvalues()[left.rows() - 1 - n];
    basis.at_points =
        Matrix(static_cast<std::size_t>(left.rows()), static_cast<std::size_t>(n));
    for (long c = 0; c < n; ++c) {
        const long k = left.rows() - 1 - c;
        const Eigen::VectorXd column = solver.eigenvectors().col(k) *
                                       std::sqrt(std::max(solver.eigenvalues()[k], 0.0));
        for (long p = 0; p < column.size(); ++p)
            basis.at_points(static_cast<std::size_t>(p), static_cast<std::size_t>(c)) =
                column[p];
    }
}

/// Of hours of two classes of day at each of the knots.
void fill_product(Basis& basis, const Eigen::VectorXd& shares) {
    constexpr long n_hours = 48;
    const auto n = static_cast<long>(basis.points.knots.size());
    Eigen::VectorXd of_hours = Eigen::VectorXd::Zero(n_hours),
                    of_knots = Eigen::VectorXd::Zero(n);
    for (long h = 0; h < n_hours; ++h)
        for (long k = 0; k < n; ++k) {
            of_hours[h] += shares[h * n + k];
            of_knots[k] += shares[h * n + k];
        }
    fill(basis, product(covariance_of_hours(2), covariance_of_knots(n)),
         product(centring(of_hours), centring(of_knots)), shares);
}

/// Quantiles of the values, those that are equal once.
std::vector<double> knots_of(std::span<const double> values, long n) {
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    std::vector<double> knots;
    constexpr double beyond = decisions::share_beyond_knots;
    for (long k = 0; k < n; ++k) {
        // The extremes are one day's: the outer knots lie within them.
        const double share = beyond + (1 - 2 * beyond) * static_cast<double>(k) /
                                          static_cast<double>(n - 1);
        const double value = sorted[static_cast<std::size_t>(
            share * static_cast<double>(sorted.size() - 1))];
        if (knots.empty() || value > knots.back() + 1e-9) knots.push_back(value);
    }
    if (knots.size() == 1) knots.push_back(knots[0] + 1);
    return knots;
}

}  // namespace

Matrix columns_of(const Basis& basis, const std::vector<std::vector<double>>& drivers) {
    const std::size_t n = drivers[0].size(), m = basis.n_columns();
    Matrix columns(n, m);
    std::vector<double> at(drivers.size());
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t d = 0; d < at.size(); ++d) at[d] = drivers[d][k];
        const Points::Weights w = basis.points.weights(at);
        const auto row = columns.row(k);
        for (std::size_t i = 0; i < w.point.size(); ++i) {
            if (w.weight[i] == 0) continue;
            const auto point = basis.at_points.row(w.point[i]);
            for (std::size_t c = 0; c < m; ++c) row[c] += w.weight[i] * point[c];
        }
    }
    return columns;
}

Basis constant() {
    return {"one", {}, Matrix(1, 1, 1.0)};
}

Basis basis_at(std::string driver, Points points,
               const std::vector<std::vector<double>>& training) {
    Basis basis{std::move(driver), std::move(points)};
    const Eigen::VectorXd shares = shares_of(basis.points, training);
    const auto n = static_cast<long>(basis.points.size());
    switch (basis.points.kind) {
        case Points::Kind::one:
            return constant();
        case Points::Kind::hours:
            fill(basis, covariance_of_hours(n / 24), centring(shares), shares);
            break;
        case Points::Kind::hours_from:
            fill(basis, covariance_of_hours(n / 24), Covariance::Identity(n, n), shares);
            break;
        case Points::Kind::knots:
            fill(basis, covariance_of_knots(n), centring(shares), shares);
            break;
        case Points::Kind::fortnights:
            fill(basis, covariance_of_walk(n), centring(shares), shares);
            break;
        case Points::Kind::hours_at_knots:
            fill_product(basis, shares);
    }
    return basis;
}

Basis hours_of_week(std::string driver, std::span<const double> training) {
    return basis_at(std::move(driver), {Points::Kind::hours},
                    {{training.begin(), training.end()}});
}

Basis hours_from(std::string driver, std::span<const double> hours,
                 std::span<const double> years, double day) {
    return basis_at(std::move(driver), {Points::Kind::hours_from, {day}},
                    {{hours.begin(), hours.end()}, {years.begin(), years.end()}});
}

Basis smooth_of(std::string driver, std::span<const double> training) {
    return basis_at(std::move(driver),
                    {Points::Kind::knots, knots_of(training, decisions::most_knots)},
                    {{training.begin(), training.end()}});
}

Basis hours_times(std::string driver, std::span<const double> hours,
                  std::span<const double> slow) {
    return basis_at(
        std::move(driver),
        {Points::Kind::hours_at_knots, knots_of(slow, decisions::most_knots_of_hours)},
        {{hours.begin(), hours.end()}, {slow.begin(), slow.end()}});
}

Basis wandering(std::string driver, std::span<const double> years) {
    Points points{Points::Kind::fortnights};
    points.n_fortnights = static_cast<std::size_t>(std::floor(
                              *std::ranges::max_element(years) * fortnights_of_year)) +
                          1;
    return basis_at(std::move(driver), std::move(points), {{years.begin(), years.end()}});
}

}  // namespace bemcal::functions
