/// The true process at other points, given runs and measurements: a conditional normal,
/// with the mean's coefficients at their values.
/// Source: textbook conditioning of a Gaussian process, covariances by paper 1, eq. 9-11.
/// The spread of coefficients that are integrated out is left to the caller.
#include "emulator/dense.hpp"
#include "emulator/process.hpp"

#include <algorithm>

namespace bemcal::emulator {

/// What is left of the outputs when the means are taken off.
void Dense::fill_residuals(const double* arguments, double* out) const {
    std::ranges::copy(outputs_, out);
    const double rho = arguments[layout_.regression()];
    const double* beta = arguments + layout_.beta();
    for (std::size_t a = 0; a < layout_.n_beta_eta; ++a)
        for (std::size_t i = 0; i < m_ + n_; ++i)
            out[i] -= (i < m_ ? 1 : rho) * beta[a] * basis_eta_(a, i);
    for (std::size_t a = 0; a < layout_.n_beta_delta; ++a)
        for (std::size_t i = 0; i < n_; ++i)
            out[m_ + i] -= beta[layout_.n_beta_eta + a] * basis_delta_(a, i);
}

/// Covariances of the true process at a point with the data.
void Dense::fill_covariance_with(std::span<const double> point, const Scales& s,
                                 double* out) {
    points_.correlate(point, s.rates_eta, weights_.data());
    measured_.correlate(point.first(layout_.p), s.rates_delta, products_.data());
    for (std::size_t i = 0; i < m_ + n_; ++i)
        out[i] = s.variance_eta * s.regression * factor(i, s) * weights_[i];
    for (std::size_t i = 0; i < n_; ++i) out[m_ + i] += s.variance_delta * products_[i];
}

bool Dense::attempt_condition(const double* arguments, double jitter, const Matrix& x,
                              Conditional& out) {
    const Scales s = scales_of(arguments);
    BorderedMatrix matrix(m_ + n_, x.rows + 1);
    place_measurements(arguments + layout_.t());
    matrix.clear();
    fill_covariance(s, jitter, matrix);
    std::vector<double> point(layout_.p + layout_.q);
    std::copy_n(arguments + layout_.t(), layout_.q, point.data() + layout_.p);
    for (std::size_t r = 0; r < x.rows; ++r) {
        std::ranges::copy(x.row(r), point.begin());
        fill_covariance_with(point, s, matrix.border(r));
    }
    const Process process(layout_, arguments);
    std::vector<double> means(x.rows);
    for (std::size_t r = 0; r < x.rows; ++r) {
        means[r] = process.mean(x.row(r));
        for (std::size_t c = 0; c <= r; ++c)
            matrix.corner(r, c) =
                s.variance_eta * s.regression * s.regression *
                    process.correlation_eta(x.row(r), x.row(c)) +
                s.variance_delta * process.correlation_delta(x.row(r), x.row(c));
    }
    fill_residuals(arguments, matrix.border(x.rows));
    if (!matrix.eliminate(Eliminate::forward, least_pivot(s)).is_definite) return false;
    out = conditional_of(matrix, std::move(means));
    return true;
}

}  // namespace bemcal::emulator
