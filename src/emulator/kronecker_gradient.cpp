/// The gradient of the Kronecker form, backwards through its three eliminations.
/// Follows from kronecker.cpp, differentiated by hand; dense_gradient is what it is
/// tested against. The way to the real line is density's; no second derivatives.
#include "emulator/kronecker.hpp"

#include <algorithm>
#include <numeric>

namespace bemcal::emulator {

/// Derivatives of the value by what the eliminations hand on.
struct Kronecker::Slopes {
    double process = 0;     ///< d value / d C : K_x
    double s = 0;           ///< by s = 1 - k'w
    double left = 0;        ///< by rho (1 - sum w), where beta is integrated out
    double precision = 0;   ///< trace of Q^-1 H_x'K_x^-1 H_x over eta's coefficients
    std::vector<double> w;  ///< [designs] by w
};

/// \param gradient  of the arguments
void Kronecker::fill_gradient(const Scales& s, double* gradient) {
    std::fill_n(gradient, layout_.size(), 0.0);
    fill_solutions();
    fill_measurement_weights();
    const Slopes slopes = slopes_of(s);
    add_noise(s, gradient);
    add_designs(s, slopes, gradient);
    add_grid(s, gradient);
    add_coefficients(gradient);
    double by_rho = 2 * s.regression * s_ / s.lambda_eta * slopes.process;
    for (std::size_t i = 0; i < n_; ++i)
        by_rho +=
            alpha_[i] * (eta_[point_[i]] + (1 - sum_w_) * mean_at_point_[point_[i]]);
    gradient[layout_.regression()] = by_rho + slopes.left * (1 - sum_w_);
}

/// What beta makes of the eliminations' solutions.
void Kronecker::fill_solutions() {
    const std::size_t n_beta = layout_.n_beta_eta;
    std::ranges::fill(mean_at_point_, 0.0);
    for (std::size_t a = 0; a < n_beta; ++a)
        for (std::size_t i = 0; i < grid_; ++i)
            mean_at_point_[i] += mean_.beta[a] * basis_eta_(a, i);
    for (std::size_t i = 0; i < n_; ++i)
        alpha_[i] = -by_measurement_.minus_solution(0)[i];
    for (std::size_t a = 0; a < mean_.size(); ++a)
        for (std::size_t i = 0; i < n_; ++i) {
            solutions_(a, i) = -by_measurement_.minus_solution(1 + a)[i];
            alpha_[i] -= mean_.beta[a] * solutions_(a, i);
        }
    mean_.times_inverse(solutions_, weighted_);
    const double* ones = by_design_.whitened(1 + grid_);
    for (std::size_t d = 0; d < designs_; ++d) {
        const double* solution = by_point_.minus_solution(d);
        for (std::size_t i = 0; i < grid_; ++i) whitened_(d, i) = -solution[i];
        for (std::size_t a = 0; a < n_beta; ++a)
            for (std::size_t i = 0; i < grid_; ++i)
                whitened_(d, i) +=
                    ones[d] * mean_.beta[a] * by_point_.minus_solution(designs_ + a)[i];
    }
}

void Kronecker::fill_measurement_weights() {
    for (std::size_t i = 0; i < n_; ++i) {
        const double* inverse = by_measurement_.minus_inverse(i);
        for (std::size_t j = 0; j <= i; ++j) {
            double weight = inverse[j] + alpha_[i] * alpha_[j];
            for (std::size_t a = 0; a < mean_.size(); ++a)
                weight += solutions_(a, i) * weighted_(a, j);
            weights_(i, j) = weights_(j, i) = weight / 2;
        }
    }
}

Kronecker::Slopes Kronecker::slopes_of(const Scales& s) const {
    Slopes slopes;
    for (std::size_t i = 0; i < n_; ++i)
        for (std::size_t j = 0; j < n_; ++j)
            slopes.process +=
                weights_(i, j) * correlations_x_(std::max(point_[i], point_[j]),
                                                 std::min(point_[i], point_[j]));
    slopes.s = s.regression * s.regression / s.lambda_eta * slopes.process;
    for (std::size_t a = 0; a < layout_.n_beta_eta; ++a) {
        for (std::size_t i = 0; i < n_; ++i)
            slopes.left -= weighted_(a, i) * basis_eta_(a, point_[i]);
        for (std::size_t b = 0; b < layout_.n_beta_eta; ++b)
            slopes.precision -=
                mean_.inverse(a, b) *
                by_point_.schur(designs_ + std::max(a, b), designs_ + std::min(a, b));
    }
    slopes.w.assign(designs_, -s.regression * slopes.left);
    for (std::size_t d = 0; d < designs_; ++d)
        for (std::size_t i = 0; i < n_; ++i)
            slopes.w[d] += s.regression * alpha_[i] * output_without_mean(d, point_[i]);
    return slopes;
}

void Kronecker::add_noise(const Scales& s, double* gradient) {
    double sum = 0;
    for (std::size_t i = 0; i < n_; ++i) {
        std::ranges::fill(row_, 0.0);
        for (std::size_t j = 0; j <= i; ++j)
            row_[j] = (i == j ? 1 : 2) * weights_(i, j) * s.variance_delta *
                      correlations_delta_(i, j);
        sum = std::accumulate(row_.begin(), row_.end(), sum);
        measured_x_.add_own_squares(i, i, row_.data(), gradient + layout_.rate_delta());
        gradient[layout_.log_lambda_e()] -= s.variance_e * weights_(i, i);
    }
    gradient[layout_.log_lambda_delta()] = -sum;
    for (std::size_t k = 0; k < layout_.p; ++k) gradient[layout_.rate_delta() + k] *= -1;
}

/// By K_x: from the runs, and from the measurements at its points.
void Kronecker::add_grid(const Scales& s, double* gradient) {
    const double squares = -by_design_.schur(1 + grid_, 1 + grid_);
    const double designs = static_cast<double>(designs_);
    for (std::size_t i = 0; i < grid_; ++i) {
        double* row = grid_weights_.row(i).data();
        const double* inverse = by_point_.minus_inverse(i);
        for (std::size_t j = 0; j < i; ++j) row[j] = designs * inverse[j];
        for (std::size_t d = 0; d < designs_; ++d)
            for (std::size_t j = 0; j < i; ++j)
                row[j] += s.lambda_eta * whitened_(d, i) * whitened_(d, j);
        for (std::size_t a = 0; a < layout_.n_beta_eta; ++a)
            for (std::size_t b = 0; b < layout_.n_beta_eta; ++b)
                for (std::size_t j = 0; j < i; ++j)
                    row[j] += s.lambda_eta * squares * mean_.inverse(a, b) *
                              by_point_.minus_solution(designs_ + a)[i] *
                              by_point_.minus_solution(designs_ + b)[j];
    }
    const double fast = s.regression * s.regression * s_ / s.lambda_eta;
    for (std::size_t i = 0; i < n_; ++i)
        for (std::size_t j = 0; j < n_; ++j)
            if (point_[j] < point_[i])
                grid_weights_(point_[i], point_[j]) += 2 * fast * weights_(i, j);
    for (std::size_t i = 0; i < grid_; ++i) {
        std::ranges::fill(row_, 0.0);
        for (std::size_t j = 0; j < i; ++j)
            row_[j] = -grid_weights_(i, j) * correlations_x_(i, j);
        x_.add_own_squares(i, i, row_.data(), gradient + layout_.rate_eta());
    }
}

/// By K_t, k and lambda_eta.
void Kronecker::add_designs(const Scales& s, const Slopes& slopes, double* gradient) {
    for (std::size_t d = 0; d < designs_; ++d) {
        w_[d] = -by_design_.minus_solution(0)[d];
        ones_[d] = -by_design_.minus_solution(1 + grid_)[d];
    }
    const std::vector<double> v = through_designs(slopes.w), cross = cross_products();
    double square = 0;  // of the mean: (H_x beta)'K_x^-1 H_x beta
    for (std::size_t a = 0; a < layout_.n_beta_eta; ++a)
        for (std::size_t b = 0; b < layout_.n_beta_eta; ++b)
            square -=
                mean_.beta[a] * mean_.beta[b] *
                by_point_.schur(designs_ + std::max(a, b), designs_ + std::min(a, b));
    const std::size_t first = designs_ + layout_.n_beta_eta;  // of the rows K_t^-1 Y
    const double points = static_cast<double>(grid_);
    for (std::size_t d = 0; d < designs_; ++d) {
        std::ranges::fill(row_, 0.0);
        for (std::size_t e = 0; e < d; ++e) {
            const double product = -by_point_.schur(first + d, first + e) -
                                   ones_[d] * cross[e] - ones_[e] * cross[d] +
                                   ones_[d] * ones_[e] * (square + slopes.precision);
            const double weight = s.lambda_eta * product +
                                  points * by_design_.minus_inverse(d)[e] - v[d] * w_[e] -
                                  v[e] * w_[d] + 2 * slopes.s * w_[d] * w_[e];
            row_[e] = -weight * correlations_t_(d, e);
        }
        t_.add_own_squares(d, d, row_.data(), gradient + layout_.rate_eta() + layout_.p);
    }
    std::ranges::fill(row_, 0.0);
    for (std::size_t d = 0; d < designs_; ++d)
        row_[d] = -k_[d] * (v[d] - 2 * slopes.s * w_[d]);
    t_.add_squares({s.t, layout_.q}, row_.data(),
                   gradient + layout_.rate_eta() + layout_.p);
    for (std::size_t k = 0; k < layout_.q; ++k)
        for (std::size_t d = 0; d < designs_; ++d)
            gradient[layout_.t() + k] +=
                2 * s.rates_t[k] * row_[d] * (s.t[k] - t_.at(d, k));
    gradient[layout_.log_lambda_eta()] = by_lambda_eta(s, slopes);
}

/// K_t^-1 times a vector.
std::vector<double> Kronecker::through_designs(const std::vector<double>& x) const {
    std::vector<double> made(designs_);
    for (std::size_t d = 0; d < designs_; ++d) {
        const double* row = by_design_.minus_inverse(d);
        for (std::size_t e = 0; e < d; ++e) {
            made[d] -= row[e] * x[e];
            made[e] -= row[e] * x[d];
        }
        made[d] -= row[d] * x[d];
    }
    return made;
}

/// K_t^-1 Y K_x^-1 H_x beta.
std::vector<double> Kronecker::cross_products() const {
    std::vector<double> made(designs_);
    const std::size_t n_beta = layout_.n_beta_eta;
    for (std::size_t d = 0; d < designs_; ++d)
        for (std::size_t a = 0; a < n_beta; ++a)
            made[d] -=
                mean_.beta[a] * by_point_.schur(designs_ + n_beta + d, designs_ + a);
    return made;
}

double Kronecker::by_lambda_eta(const Scales& s, const Slopes& slopes) const {
    const double* ones = by_design_.whitened(1 + grid_);
    double squares = 0;
    for (std::size_t i = 0; i < grid_; ++i) {
        const double* whitened = by_design_.whitened(1 + i);
        for (std::size_t d = 0; d < designs_; ++d)
            squares += whitened_(d, i) * (whitened[d] - ones[d] * mean_at_point_[i]);
    }
    const double of_ones = -by_design_.schur(1 + grid_, 1 + grid_);
    const double size = static_cast<double>(designs_) * static_cast<double>(grid_);
    return (size - s.lambda_eta * (squares + slopes.precision * of_ones)) / 2 -
           slopes.s * s_;
}

void Kronecker::add_coefficients(double* gradient) const {
    if (!layout_.samples_beta) return;
    for (std::size_t a = 0; a < mean_.size(); ++a) {
        gradient[layout_.beta() + a] = mean_.right_side[a];
        for (std::size_t b = 0; b < mean_.size(); ++b)
            gradient[layout_.beta() + a] -= mean_.precision(a, b) * mean_.beta[b];
    }
}

}  // namespace bemcal::emulator
