/// A made-up calibration small enough for the plainest algebra: a simulator of two known
/// and two calibrated inputs at designs times points, and a plain Gaussian likelihood of
/// it, in extended precision.
#pragma once

#include "emulator/density.hpp"

#include <cmath>
#include <vector>

namespace bemcal::emulator::test {

struct StudySize {
    std::size_t designs = 5, points = 6, measured = 6;
};

/// Measurements lie at the points in turn.
inline Observations small_study(const StudySize& size, std::uint64_t seed) {
    Stream random(seed, 0, 0);
    Observations o;
    Matrix x(size.points, 2), t(size.designs, 2);
    for (double& v : x.values) v = 10 + 5 * random.uniform();
    for (double& v : t.values) v = random.uniform();
    const auto simulate = [](std::span<const double> a, double t1, double t2) {
        return 100 + 30 * std::sin(a[0] / 2) + 20 * t1 * a[1] / 15 + 10 * t2 * t2;
    };
    const std::size_t m = size.designs * size.points;
    o.simulated_x = Matrix(m, 2);
    o.simulated_t = Matrix(m, 2);
    for (std::size_t d = 0, row = 0; d < size.designs; ++d)
        for (std::size_t i = 0; i < size.points; ++i, ++row)
            for (std::size_t k = 0; k < 2; ++k) {
                o.simulated_x(row, k) = x(i, k);
                o.simulated_t(row, k) = t(d, k);
                if (k == 1) o.simulated.push_back(simulate(x.row(i), t(d, 0), t(d, 1)));
            }
    o.measured_x = Matrix(size.measured, 2);
    for (std::size_t i = 0; i < size.measured; ++i) {
        for (std::size_t k = 0; k < 2; ++k) o.measured_x(i, k) = x(i % size.points, k);
        o.measured.push_back(simulate(o.measured_x.row(i), 0.4, 0.6) + 3 +
                             2 * random.uniform());
    }
    return o;
}

using Long = long double;
using LongMatrix = std::vector<std::vector<Long>>;

/// Solves A X = B by elimination without exchange of rows; A is positive definite.
/// \returns log |A|
inline Long solve(LongMatrix a, LongMatrix& b) {
    const std::size_t n = a.size();
    Long log_determinant = 0;
    for (std::size_t k = 0; k < n; ++k) {
        log_determinant += std::log(a[k][k]);
        for (std::size_t i = 0; i < n; ++i) {
            if (i == k) continue;
            const Long factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
            for (std::size_t j = 0; j < b[k].size(); ++j) b[i][j] -= factor * b[k][j];
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        for (Long& value : b[i]) value /= a[i][i];
    return log_determinant;
}

/// Runs, measurements, then points of the true process: covariance, mean's basis.
struct PlainModel {
    const Observations& o;
    const Layout& layout;
    const double* arguments;

    std::size_t m() const { return o.simulated.size(); }
    std::size_t n() const { return m() + o.measured.size(); }

    double x(const Matrix& more, std::size_t row, std::size_t k) const {
        if (row < m()) return o.simulated_x(row, k);
        return row < n() ? o.measured_x(row - m(), k) : more(row - n(), k);
    }
    Long factor(std::size_t row) const {
        return row < m() ? 1.0L : static_cast<Long>(arguments[layout.regression()]);
    }
    Long covariance(const Matrix& more, std::size_t i, std::size_t j) const {
        Long fast = 0, slow = 0;
        for (std::size_t k = 0; k < layout.p; ++k) {
            const Long d = static_cast<Long>(x(more, i, k)) - x(more, j, k);
            fast += arguments[layout.rate_eta() + k] * d * d;
            slow += arguments[layout.rate_delta() + k] * d * d;
        }
        for (std::size_t k = 0; k < layout.q; ++k) {
            const auto t = [&](std::size_t row) {
                return row < m() ? o.simulated_t(row, k) : arguments[layout.t() + k];
            };
            const Long d = static_cast<Long>(t(i)) - t(j);
            fast += arguments[layout.rate_eta() + layout.p + k] * d * d;
        }
        Long sum = factor(i) * factor(j) * std::exp(-fast) *
                   std::exp(-static_cast<Long>(arguments[layout.log_lambda_eta()]));
        if (i < m() || j < m()) return sum;
        sum += std::exp(-slow - arguments[layout.log_lambda_delta()]);
        if (i == j && i < n())
            sum += std::exp(-static_cast<Long>(arguments[layout.log_lambda_e()]));
        return sum;
    }
    /// Of the means' coefficients.
    std::vector<Long> basis(const Matrix& more, std::size_t row) const {
        std::vector<double> at(layout.p), h(1 + layout.p);
        for (std::size_t k = 0; k < layout.p; ++k) at[k] = x(more, row, k);
        std::vector<Long> made;
        basis_of(layout.emulator_mean, at.data(), layout.p, h.data());
        for (std::size_t a = 0; a < layout.n_beta_eta; ++a)
            made.push_back(factor(row) * h[a]);
        basis_of(layout.discrepancy_mean, at.data(), layout.p, h.data());
        for (std::size_t a = 0; a < layout.n_beta_delta; ++a)
            made.push_back(row < m() ? 0 : h[a]);
        return made;
    }
    LongMatrix data_covariance() const {
        LongMatrix k(n(), std::vector<Long>(n()));
        for (std::size_t i = 0; i < n(); ++i)
            for (std::size_t j = 0; j < n(); ++j) k[i][j] = covariance({}, i, j);
        return k;
    }
    double output(std::size_t row) const {
        return row < m() ? o.simulated[row] : o.measured[row - m()];
    }
    Long mean(const Matrix& more, std::size_t row) const {
        Long sum = 0;
        const std::vector<Long> h = basis(more, row);
        for (std::size_t a = 0; a < h.size(); ++a)
            sum += h[a] * arguments[layout.beta() + a];
        return sum;
    }

    /// At the beta of the arguments.
    Long log_likelihood() const {
        LongMatrix residuals(n(), std::vector<Long>(1));
        for (std::size_t i = 0; i < n(); ++i) residuals[i][0] = output(i) - mean({}, i);
        LongMatrix solved = residuals;
        Long value = -solve(data_covariance(), solved) / 2;
        for (std::size_t i = 0; i < n(); ++i) value -= residuals[i][0] * solved[i][0] / 2;
        return value;
    }

    /// Integrated over beta: R&W eq. 2.45, without 2 pi.
    Long integrated_log_likelihood() const {
        const std::size_t k = layout.n_beta();
        LongMatrix right(n(), std::vector<Long>(k + 1));
        for (std::size_t i = 0; i < n(); ++i) {
            const std::vector<Long> h = basis({}, i);
            std::copy(h.begin(), h.end(), right[i].begin());
            right[i][k] = output(i);
        }
        LongMatrix solved = right;
        const Long determinant = solve(data_covariance(), solved);
        LongMatrix q(k, std::vector<Long>(k)), b(k, std::vector<Long>(1));
        Long square = 0;
        for (std::size_t i = 0; i < n(); ++i) {
            for (std::size_t a = 0; a < k; ++a) {
                for (std::size_t c = 0; c < k; ++c) q[a][c] += right[i][a] * solved[i][c];
                b[a][0] += right[i][a] * solved[i][k];
            }
            square += right[i][k] * solved[i][k];
        }
        LongMatrix beta = b;
        const Long of_q = solve(q, beta);
        for (std::size_t a = 0; a < k; ++a) square -= b[a][0] * beta[a][0];
        return -(determinant + of_q + square) / 2;
    }

    Conditional condition(const Matrix& more) const {
        LongMatrix right(n(), std::vector<Long>(more.rows + 1));
        for (std::size_t i = 0; i < n(); ++i) {
            for (std::size_t r = 0; r < more.rows; ++r)
                right[i][r] = covariance(more, i, n() + r);
            right[i][more.rows] = output(i) - mean({}, i);
        }
        LongMatrix solved = right;
        solve(data_covariance(), solved);
        Conditional made{std::vector<double>(more.rows), Matrix(more.rows, more.rows)};
        for (std::size_t r = 0; r < more.rows; ++r) {
            Long at = mean(more, n() + r);
            for (std::size_t i = 0; i < n(); ++i)
                at += right[i][r] * solved[i][more.rows];
            made.mean[r] = static_cast<double>(at);
            for (std::size_t c = 0; c < more.rows; ++c) {
                Long between = covariance(more, n() + r, n() + c);
                for (std::size_t i = 0; i < n(); ++i)
                    between -= right[i][r] * solved[i][c];
                made.covariance(r, c) = static_cast<double>(between);
            }
        }
        return made;
    }
};

}  // namespace bemcal::emulator::test
