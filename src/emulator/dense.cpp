/// The likelihood with every pair of rows, runs first, then measurements: covariance,
/// mean's coefficients and data eliminated together.
/// Source: paper 1, eq. 11-12 (Kennedy and O'Hagan 2001), misprints mended. Its cost
/// grows with the cube of the rows; full grids have kronecker.
#include "emulator/dense.hpp"

#include "emulator/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bemcal::emulator {

namespace {

/// x of the runs, then of the measurements.
Matrix all_x(const Observations& o) {
    Matrix x = o.simulated_x;
    x.rows += o.measured_x.rows;
    x.values.insert(x.values.end(), o.measured_x.values.begin(),
                    o.measured_x.values.end());
    return x;
}

Points rows_of(const Observations& o) {
    const std::size_t m = o.simulated.size(), n = o.measured.size();
    const std::size_t p = o.measured_x.cols, q = o.simulated_t.cols;
    Points points(m + n, p + q);
    for (std::size_t i = 0; i < m + n; ++i)
        for (std::size_t k = 0; k < p; ++k)
            points.at(i, k) = i < m ? o.simulated_x(i, k) : o.measured_x(i - m, k);
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t k = 0; k < q; ++k) points.at(i, p + k) = o.simulated_t(i, k);
    return points;
}

}  // namespace

std::unique_ptr<Likelihood> make_dense(const Observations& standardised,
                                       const Layout& layout) {
    return std::make_unique<Dense>(standardised, layout);
}

Dense::Dense(const Observations& o, const Layout& layout)
    : Likelihood(layout),
      m_(o.simulated.size()),
      n_(o.measured.size()),
      outputs_(o.simulated),
      points_(rows_of(o)),
      measured_(o.measured_x),
      basis_eta_(bases(layout.emulator_mean, layout.n_beta_eta, all_x(o))),
      basis_delta_(bases(layout.discrepancy_mean, layout.n_beta_delta, o.measured_x)),
      matrix_(m_ + n_, 1 + layout.n_beta()),
      correlations_(m_ + n_, in_fours(m_ + n_)),
      slow_(n_, in_fours(n_)),
      mean_(layout.n_beta(), layout.samples_beta),
      alpha_(m_ + n_),
      solutions_(layout.n_beta(), m_ + n_),
      weighted_(layout.n_beta(), m_ + n_),
      weights_(in_fours(m_ + n_)),
      products_(in_fours(m_ + n_)) {
    outputs_.insert(outputs_.end(), o.measured.begin(), o.measured.end());
}

Dense::Scales Dense::scales_of(const double* arguments) const {
    return {std::exp(-arguments[layout_.log_lambda_eta()]),
            std::exp(-arguments[layout_.log_lambda_delta()]),
            std::exp(-arguments[layout_.log_lambda_e()]),
            arguments[layout_.regression()],
            arguments + layout_.rate_eta(),
            arguments + layout_.rate_delta()};
}

double Dense::least_pivot(const Scales& s) const {
    return std::numeric_limits<double>::epsilon() * static_cast<double>(m_ + n_) *
           s.variance_eta;
}

void Dense::place_measurements(const double* t) {
    for (std::size_t i = m_; i < m_ + n_; ++i)
        for (std::size_t k = 0; k < layout_.q; ++k) points_.at(i, layout_.p + k) = t[k];
}

void Dense::fill_covariance(const Scales& s, double jitter, BorderedMatrix& matrix) {
    for (std::size_t i = 0; i < m_ + n_; ++i) {
        double* row = matrix.row(i);
        double* correlation = correlations_.row(i).data();
        points_.correlate_own(i, i + 1, s.rates_eta, correlation);
        correlation[i] += jitter;
        const double with_runs = s.variance_eta * factor(i, s);
        for (std::size_t j = 0; j <= i; ++j)
            row[j] = with_runs * factor(j, s) * correlation[j];
    }
    for (std::size_t i = 0; i < n_; ++i) {
        double* row = matrix.row(m_ + i) + m_;
        measured_.correlate_own(i, i + 1, s.rates_delta, slow_.row(i).data());
        for (std::size_t j = 0; j <= i; ++j) row[j] += s.variance_delta * slow_(i, j);
        row[i] += s.variance_e;
    }
}

void Dense::fill_border(const Scales& s) {
    std::ranges::copy(outputs_, matrix_.border(0));
    for (std::size_t a = 0; a < layout_.n_beta_eta; ++a)
        for (std::size_t i = 0; i < m_ + n_; ++i)
            matrix_.border(1 + a)[i] = factor(i, s) * basis_eta_(a, i);
    for (std::size_t a = 0; a < layout_.n_beta_delta; ++a)
        std::ranges::copy(basis_delta_.row(a),
                          matrix_.border(1 + layout_.n_beta_eta + a) + m_);
}

bool Dense::solve_coefficients(const double* arguments) {
    for (std::size_t a = 0; a < mean_.size(); ++a) {
        mean_.right_side[a] = -matrix_.schur(1 + a, 0);
        for (std::size_t b = 0; b <= a; ++b)
            mean_.precision(a, b) = mean_.precision(b, a) = -matrix_.schur(1 + a, 1 + b);
    }
    if (!mean_.solve(arguments + layout_.beta())) return false;
    coefficients_ = {mean_.beta, mean_.inverse};
    return true;
}

double Dense::value_of(const Eliminated& done) const {
    return (matrix_.schur(0, 0) - done.log_determinant) / 2 + mean_.log_likelihood();
}

bool Dense::attempt(const double* arguments, double jitter, double* gradient,
                    double& value) {
    const Scales s = scales_of(arguments);
    place_measurements(arguments + layout_.t());
    matrix_.clear();
    fill_covariance(s, jitter, matrix_);
    fill_border(s);
    const Eliminated done =
        matrix_.eliminate(gradient == nullptr ? Eliminate::forward : Eliminate::fully,
                          std::numeric_limits<double>::epsilon() *
                              static_cast<double>(m_ + n_) * s.variance_eta);
    if (!done.is_definite || !solve_coefficients(arguments)) return false;
    value = value_of(done);
    if (gradient != nullptr) fill_gradient(s, gradient);
    return std::isfinite(value);
}

}  // namespace bemcal::emulator
