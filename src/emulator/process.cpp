/// The true process rho eta + delta before any data: means and correlations at points,
/// and the conditional that an elimination leaves.
/// Source: paper 1, eq. 3-4 and 9-10. One pair of points at a time; many are
/// correlation's.
#include "emulator/process.hpp"

#include <cmath>
#include <utility>

namespace bemcal::emulator {

namespace {

double correlation(std::span<const double> a, std::span<const double> b,
                   const double* rates) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += rates[k] * (a[k] - b[k]) * (a[k] - b[k]);
    return std::exp(-sum);
}

double linear(Mean mean, std::size_t n_beta, std::span<const double> x,
              const double* beta) {
    std::vector<double> h(n_beta);
    basis_of(mean, x.data(), x.size(), h.data());
    double sum = 0;
    for (std::size_t a = 0; a < n_beta; ++a) sum += h[a] * beta[a];
    return sum;
}

}  // namespace

Process::Process(const Layout& layout, const double* arguments)
    : regression(arguments[layout.regression()]),
      variance_eta(std::exp(-arguments[layout.log_lambda_eta()])),
      variance_delta(std::exp(-arguments[layout.log_lambda_delta()])),
      variance_e(std::exp(-arguments[layout.log_lambda_e()])),
      layout_(layout),
      arguments_(arguments) {}

double Process::mean_of_eta(std::span<const double> x) const {
    return linear(layout_.emulator_mean, layout_.n_beta_eta, x,
                  arguments_ + layout_.beta());
}

double Process::mean_of_delta(std::span<const double> x) const {
    return linear(layout_.discrepancy_mean, layout_.n_beta_delta, x,
                  arguments_ + layout_.beta() + layout_.n_beta_eta);
}

double Process::correlation_eta(std::span<const double> a,
                                std::span<const double> b) const {
    return correlation(a, b, arguments_ + layout_.rate_eta());
}

double Process::correlation_delta(std::span<const double> a,
                                  std::span<const double> b) const {
    return correlation(a, b, arguments_ + layout_.rate_delta());
}

Conditional conditional_of(const BorderedMatrix& matrix, std::vector<double> means) {
    const std::size_t n = means.size();
    Conditional made{std::move(means), Matrix(n, n)};
    for (std::size_t r = 0; r < n; ++r) {
        made.mean[r] -= matrix.schur(n, r);
        for (std::size_t s = 0; s <= r; ++s)
            made.covariance(r, s) = made.covariance(s, r) = matrix.schur(r, s);
    }
    return made;
}

}  // namespace bemcal::emulator
