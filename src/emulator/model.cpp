/// The choices of a Kennedy-O'Hagan model: default priors, where its arguments stand, and
/// the bases of its means.
/// Source: Kennedy and O'Hagan 2001; Chong and Menberg 2018 (bc-stan); paper 1, Table 7,
/// its two precisions under the right symbols. Means beyond linear in x are left out.
#include "emulator/model.hpp"

#include <algorithm>

namespace bemcal::emulator {

namespace {

stats::Prior beta(double b) {
    return {stats::PriorKind::beta, 1, b, 0, 1, true};
}

stats::Prior gamma(double shape, double rate) {
    stats::Prior prior;
    prior.kind = stats::PriorKind::gamma;
    prior.a = shape;
    prior.b = rate;
    return prior;
}

Priors priors_with(double eta, double delta) {
    Priors priors;
    priors.rho_eta = beta(eta);
    priors.rho_delta = beta(delta);
    priors.lambda_eta = gamma(10, 10);
    priors.lambda_delta = gamma(10, 0.3);
    priors.lambda_e = gamma(10, 0.03);
    return priors;
}

std::size_t n_coefficients(Mean mean, std::size_t p) {
    return mean == Mean::none ? 0 : mean == Mean::constant ? 1 : 1 + p;
}

}  // namespace

Priors bc_stan_priors() {
    return priors_with(0.3, 0.3);
}

Priors table_7_priors() {
    return priors_with(0.5, 0.4);
}

Layout layout_of(const ModelOptions& options, std::size_t p, std::size_t q) {
    Layout layout;
    layout.p = p;
    layout.q = q;
    layout.emulator_mean = options.emulator_mean;
    layout.discrepancy_mean = options.discrepancy_mean;
    layout.n_beta_eta = n_coefficients(options.emulator_mean, p);
    layout.n_beta_delta = n_coefficients(options.discrepancy_mean, p);
    layout.samples_beta = options.coefficients == Coefficients::sampled;
    return layout;
}

void basis_of(Mean mean, const double* x, std::size_t p, double* out) {
    if (mean == Mean::none) return;
    out[0] = 1;
    if (mean == Mean::linear) std::copy_n(x, p, out + 1);
}

Matrix bases(Mean mean, std::size_t n_beta, const Matrix& x) {
    Matrix made(n_beta, x.rows);
    std::vector<double> h(n_beta);
    for (std::size_t i = 0; i < x.rows; ++i) {
        basis_of(mean, x.row(i).data(), x.cols, h.data());
        for (std::size_t a = 0; a < n_beta; ++a) made(a, i) = h[a];
    }
    return made;
}

}  // namespace bemcal::emulator
