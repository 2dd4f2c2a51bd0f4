/// The gradient of the dense form: d value / d K = (alpha alpha' - K^-1) / 2, plus what
/// the integrated coefficients add, times the derivatives of eq. 9-10.
/// Source: textbook; paper 1, eq. 9-12. The way to the real line is density's; jitter
/// counts as part of K.
#include "emulator/dense.hpp"

#include <algorithm>

namespace bemcal::emulator {

void Dense::fill_alpha() {
    for (std::size_t i = 0; i < m_ + n_; ++i) alpha_[i] = -matrix_.minus_solution(0)[i];
    for (std::size_t a = 0; a < mean_.size(); ++a)
        for (std::size_t i = 0; i < m_ + n_; ++i) {
            solutions_(a, i) = -matrix_.minus_solution(1 + a)[i];
            alpha_[i] -= mean_.beta[a] * solutions_(a, i);
        }
    mean_.times_inverse(solutions_, weighted_);
}

void Dense::fill_gradient(const Scales& s, double* gradient) {
    std::fill_n(gradient, layout_.size(), 0.0);
    fill_alpha();
    for (std::size_t i = 0; i < m_ + n_; ++i) {
        fill_weights(i);
        if (i >= m_) add_noise_row(i, s, gradient);
        add_process_row(i, s, gradient);
    }
    for (std::size_t k = layout_.rate_eta(); k < layout_.log_lambda_eta(); ++k)
        gradient[k] = -gradient[k];
    const double* rates = s.rates_eta + layout_.p;
    for (std::size_t k = 0; k < layout_.q; ++k) gradient[k] *= -2 * rates[k];
    add_mean_gradient(gradient);
}

/// d value / d K_ij, twice below the diagonal.
void Dense::fill_weights(std::size_t i) {
    const double* inverse = matrix_.minus_inverse(i);
    const double alpha = alpha_[i];
    for (std::size_t j = 0; j <= i; ++j) weights_[j] = inverse[j] + alpha * alpha_[j];
    for (std::size_t a = 0; a < mean_.size(); ++a)
        for (std::size_t j = 0; j <= i; ++j)
            weights_[j] += solutions_(a, i) * weighted_(a, j);
    weights_[i] /= 2;
}

void Dense::add_process_row(std::size_t i, const Scales& s, double* gradient) {
    const double* correlation = correlations_.row(i).data();
    const double with_runs = s.variance_eta * factor(i, s);
    double runs = 0, measurements = 0;
    for (std::size_t j = 0; j <= i; ++j) {
        const double product = with_runs * weights_[j] * correlation[j];
        products_[j] = product * factor(j, s);
        (j < m_ ? runs : measurements) += product;
    }
    std::fill(products_.begin() + static_cast<std::ptrdiff_t>(i) + 1, products_.end(), 0);
    gradient[layout_.log_lambda_eta()] -= runs + s.regression * measurements;
    points_.add_own_squares(i, i + 1, products_.data(), gradient + layout_.rate_eta());
    if (i < m_) return;
    // the row has the factor rho as well: derivatives without it
    for (std::size_t j = 0; j <= i; ++j)
        gradient[layout_.regression()] += s.variance_eta * weights_[j] * correlation[j] *
                                          (j < m_ ? 1 : 2 * s.regression);
    for (std::size_t k = 0; k < layout_.q; ++k)
        for (std::size_t j = 0; j < m_; ++j)
            gradient[k] += products_[j] *
                           (points_.at(i, layout_.p + k) - points_.at(j, layout_.p + k));
}

void Dense::add_noise_row(std::size_t row, const Scales& s, double* gradient) {
    const std::size_t i = row - m_;
    double sum = 0;
    for (std::size_t j = 0; j <= i; ++j) {
        products_[j] = s.variance_delta * weights_[m_ + j] * slow_(i, j);
        sum += products_[j];
    }
    std::fill(products_.begin() + static_cast<std::ptrdiff_t>(i) + 1, products_.end(), 0);
    gradient[layout_.log_lambda_delta()] -= sum;
    gradient[layout_.log_lambda_e()] -= s.variance_e * weights_[row];
    measured_.add_own_squares(i, i + 1, products_.data(),
                              gradient + layout_.rate_delta());
}

void Dense::add_mean_gradient(double* gradient) {
    for (std::size_t a = 0; a < layout_.n_beta_eta; ++a)
        for (std::size_t i = m_; i < m_ + n_; ++i)
            gradient[layout_.regression()] +=
                basis_eta_(a, i) * (alpha_[i] * mean_.beta[a] - weighted_(a, i));
    if (!layout_.samples_beta) return;
    for (std::size_t a = 0; a < mean_.size(); ++a) {
        double slope = mean_.right_side[a];
        for (std::size_t b = 0; b < mean_.size(); ++b)
            slope -= mean_.precision(a, b) * mean_.beta[b];
        gradient[layout_.beta() + a] = slope;
    }
}

}  // namespace bemcal::emulator
