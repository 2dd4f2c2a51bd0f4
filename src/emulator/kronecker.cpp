/// The likelihood where runs are a full grid: that of the runs times that of the
/// measurements given the runs, by three small eliminations (designs, grid points,
/// measurements).
/// Source: paper 1, eq. 12; the Kronecker product of covariances, textbook. It is exact.
/// Runs that are no grid need the dense form.
#include "emulator/kronecker.hpp"

#include "emulator/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bemcal::emulator {

namespace {

double least_pivot(std::size_t n) {
    return std::numeric_limits<double>::epsilon() * static_cast<double>(n);
}

/// Correlations of points with each other, and into a matrix.
void fill(const Points& points, const double* rates, double jitter,
          Matrix& correlations) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        double* row = correlations.row(i).data();
        points.correlate_own(i, i + 1, rates, row);
        row[i] += jitter;
    }
}

void copy_lower(const Matrix& from, BorderedMatrix& to) {
    for (std::size_t i = 0; i < from.rows; ++i)
        std::copy_n(from.row(i).data(), i + 1, to.row(i));
}

}  // namespace

std::unique_ptr<Likelihood> make_kronecker(const Grid& grid,
                                           const Observations& standardised,
                                           const Layout& layout) {
    return std::make_unique<Kronecker>(grid, standardised, layout);
}

Kronecker::Kronecker(const Grid& grid, const Observations& o, const Layout& layout)
    : Likelihood(layout),
      designs_(grid.t.rows),
      grid_(grid.x.rows),
      n_(o.measured.size()),
      output_(grid.output),
      measured_(o.measured),
      point_(grid.of_measured),
      grid_x_(grid.x),
      x_of_measured_(o.measured_x),
      t_(grid.t),
      x_(grid.x),
      measured_x_(o.measured_x),
      basis_eta_(bases(layout.emulator_mean, layout.n_beta_eta, grid.x)),
      basis_delta_(bases(layout.discrepancy_mean, layout.n_beta_delta, o.measured_x)),
      by_design_(designs_, grid_ + 2),
      by_point_(grid_, 2 * designs_ + layout.n_beta_eta),
      by_measurement_(n_, 1 + layout.n_beta()),
      correlations_t_(designs_, in_fours(designs_)),
      correlations_x_(grid_, in_fours(grid_)),
      correlations_delta_(n_, in_fours(n_)),
      k_(in_fours(designs_)),
      w_(designs_),
      ones_(designs_),
      eta_(grid_),
      mean_(layout.n_beta(), layout.samples_beta),
      mean_at_point_(grid_),
      alpha_(n_),
      weights_(n_, n_),
      solutions_(layout.n_beta(), n_),
      weighted_(layout.n_beta(), n_),
      whitened_(designs_, grid_),
      grid_weights_(grid_, grid_),
      row_(in_fours(std::max({designs_, grid_, n_}))) {}

Kronecker::Scales Kronecker::scales_of(const double* arguments) const {
    return {std::exp(arguments[layout_.log_lambda_eta()]),
            std::exp(-arguments[layout_.log_lambda_delta()]),
            std::exp(-arguments[layout_.log_lambda_e()]),
            arguments[layout_.regression()],
            arguments + layout_.t(),
            arguments + layout_.rate_eta(),
            arguments + layout_.rate_eta() + layout_.p,
            arguments + layout_.rate_delta()};
}

/// The border: k', then Y', then 1'.
bool Kronecker::eliminate_designs(const Scales& s, double jitter, Eliminate what) {
    by_design_.clear();
    fill(t_, s.rates_t, jitter, correlations_t_);
    copy_lower(correlations_t_, by_design_);
    t_.correlate({s.t, layout_.q}, s.rates_t, k_.data());
    std::copy_n(k_.data(), designs_, by_design_.border(0));
    for (std::size_t a = 0; a < designs_; ++a) {
        for (std::size_t i = 0; i < grid_; ++i)
            by_design_.border(1 + i)[a] = output_(a, i);
        by_design_.border(1 + grid_)[a] = 1;
    }
    design_ = by_design_.eliminate(what, least_pivot(designs_));
    s_ = 1 + by_design_.schur(0, 0);
    sum_w_ = -by_design_.schur(1 + grid_, 0);
    for (std::size_t i = 0; i < grid_; ++i) eta_[i] = -by_design_.schur(1 + i, 0);
    return design_.is_definite;
}

void Kronecker::fill_x_correlations(const Scales& s, double jitter) {
    fill(x_, s.rates_x, jitter, correlations_x_);
}

/// The border: L_t^-1 Y, then H_x', then K_t^-1 Y where the gradient is wanted.
bool Kronecker::eliminate_grid(const Scales& s, double jitter, Eliminate what) {
    by_point_.clear();
    fill_x_correlations(s, jitter);
    copy_lower(correlations_x_, by_point_);
    const std::size_t n_beta = layout_.n_beta_eta;
    for (std::size_t i = 0; i < grid_; ++i) {
        const double* whitened = by_design_.whitened(1 + i);
        const double* solution = by_design_.minus_solution(1 + i);
        for (std::size_t a = 0; a < designs_; ++a) by_point_.border(a)[i] = whitened[a];
        for (std::size_t a = 0; what == Eliminate::fully && a < designs_; ++a)
            by_point_.border(designs_ + n_beta + a)[i] = -solution[a];
    }
    for (std::size_t b = 0; b < n_beta; ++b)
        std::ranges::copy(basis_eta_.row(b), by_point_.border(designs_ + b));
    point_done_ = by_point_.eliminate(what, least_pivot(grid_));
    return point_done_.is_definite;
}

/// Covariance and residuals of the measurements, given the runs.
void Kronecker::fill_conditional(const Scales& s, BorderedMatrix& matrix) {
    const double fast = s.regression * s.regression * s_ / s.lambda_eta;
    for (std::size_t i = 0; i < n_; ++i) {
        double* slow = correlations_delta_.row(i).data();
        measured_x_.correlate_own(i, i + 1, s.rates_delta, slow);
        double* row = matrix.row(i);
        for (std::size_t j = 0; j <= i; ++j)
            row[j] = fast * correlations_x_(std::max(point_[i], point_[j]),
                                            std::min(point_[i], point_[j])) +
                     s.variance_delta * slow[j];
        row[i] += s.variance_e;
    }
}

double Kronecker::least_pivot_of_measurements(const Scales& s) const {
    return least_pivot(n_) * (s.variance_e + s.variance_delta);
}

/// The border: the residuals, then the means' bases.
bool Kronecker::eliminate_measurements(const Scales& s, Eliminate what) {
    by_measurement_.clear();
    fill_conditional(s, by_measurement_);
    for (std::size_t i = 0; i < n_; ++i)
        by_measurement_.border(0)[i] = measured_[i] - s.regression * eta_[point_[i]];
    const double left = s.regression * (1 - sum_w_);
    for (std::size_t a = 0; a < layout_.n_beta_eta; ++a)
        for (std::size_t i = 0; i < n_; ++i)
            by_measurement_.border(1 + a)[i] = left * basis_eta_(a, point_[i]);
    for (std::size_t a = 0; a < layout_.n_beta_delta; ++a)
        std::ranges::copy(basis_delta_.row(a),
                          by_measurement_.border(1 + layout_.n_beta_eta + a));
    measurement_ = by_measurement_.eliminate(what, least_pivot_of_measurements(s));
    return measurement_.is_definite;
}

/// Q = Q of the runs + Q of the measurements, and the right side likewise.
bool Kronecker::solve_coefficients(const Scales& s, const double* arguments) {
    const double squares = -by_design_.schur(1 + grid_, 1 + grid_);  // 1'K_t^-1 1
    const double* ones = by_design_.whitened(1 + grid_);
    for (std::size_t a = 0; a < mean_.size(); ++a) {
        mean_.right_side[a] = -by_measurement_.schur(1 + a, 0);
        for (std::size_t b = 0; b <= a; ++b)
            mean_.precision(a, b) = -by_measurement_.schur(1 + a, 1 + b);
    }
    for (std::size_t a = 0; a < layout_.n_beta_eta; ++a) {
        for (std::size_t d = 0; d < designs_; ++d)
            mean_.right_side[a] -=
                s.lambda_eta * ones[d] * by_point_.schur(designs_ + a, d);
        for (std::size_t b = 0; b <= a; ++b)
            mean_.precision(a, b) -=
                s.lambda_eta * squares * by_point_.schur(designs_ + a, designs_ + b);
    }
    for (std::size_t a = 0; a < mean_.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) mean_.precision(b, a) = mean_.precision(a, b);
    if (!mean_.solve(arguments + layout_.beta())) return false;
    coefficients_ = {mean_.beta, mean_.inverse};
    return true;
}

double Kronecker::value_of(const Scales& s) const {
    const double designs = static_cast<double>(designs_),
                 points = static_cast<double>(grid_);
    double squares = 0;  // of the runs, whitened
    for (std::size_t a = 0; a < designs_; ++a) squares -= by_point_.schur(a, a);
    const double runs =
        (designs * points * std::log(s.lambda_eta) - points * design_.log_determinant -
         designs * point_done_.log_determinant - s.lambda_eta * squares) /
        2;
    const double measurements =
        (by_measurement_.schur(0, 0) - measurement_.log_determinant) / 2;
    return runs + measurements + mean_.log_likelihood();
}

bool Kronecker::attempt(const double* arguments, double jitter, double* gradient,
                        double& value) {
    const Scales s = scales_of(arguments);
    const Eliminate what = gradient == nullptr ? Eliminate::forward : Eliminate::fully;
    if (!eliminate_designs(s, jitter, what) || !eliminate_grid(s, jitter, what) ||
        !eliminate_measurements(s, what) || !solve_coefficients(s, arguments))
        return false;
    value = value_of(s);
    if (gradient != nullptr) fill_gradient(s, gradient);
    return std::isfinite(value);
}

}  // namespace bemcal::emulator
