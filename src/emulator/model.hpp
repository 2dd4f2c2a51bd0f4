/// The model of Kennedy and O'Hagan 2001 (paper 1, eq. 3-13), as a choice of parts:
///
///     run         y = eta(x, t)
///     measurement z = rho eta(x, theta) + delta(x) + e
///
/// eta and delta are Gaussian processes with means h'beta and the covariances of eq.
/// 9-10; e is white, of variance 1 / lambda_e. All on the standardised scale.
#pragma once

#include "base/matrix.hpp"
#include "stats/prior.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace bemcal::emulator {

enum class Mean { none, constant, linear };       ///< h = nothing; 1; 1, x
enum class Coefficients { integrated, sampled };  ///< beta, with its flat prior
enum class Form { kronecker_if_grid, dense };

/// Correlations have priors as rho = exp(-rate / 4), the correlation at distance 1/2.
struct Priors {
    std::vector<stats::Prior> t;  ///< [q] on the scale 0 to 1; empty = uniform
    stats::Prior rho_eta, rho_delta;
    stats::Prior lambda_eta, lambda_delta, lambda_e;
    stats::Prior regression{stats::PriorKind::fixed, 1};
};

/// Those of Chong and Menberg 2018 as their code bc-stan has them: rho ~ Beta(1, 0.3),
/// lambda_eta ~ Gamma(10, 10), lambda_delta ~ Gamma(10, 0.3), lambda_e ~ Gamma(10, 0.03).
Priors bc_stan_priors();
/// Paper 1, Table 7, with its two precisions under the symbols that their meanings have:
/// rho_eta ~ Beta(1, 0.5), rho_delta ~ Beta(1, 0.4); precisions as above.
Priors table_7_priors();

struct ModelOptions {
    Mean emulator_mean = Mean::none, discrepancy_mean = Mean::none;
    Coefficients coefficients = Coefficients::integrated;
    Priors priors = bc_stan_priors();
    Form form = Form::kronecker_if_grid;
};

/// Where a likelihood finds its arguments, all real numbers.
struct Layout {
    std::size_t p = 0, q = 0;  ///< inputs x and t
    std::size_t n_beta_eta = 0, n_beta_delta = 0;
    Mean emulator_mean = Mean::none, discrepancy_mean = Mean::none;
    bool samples_beta = false;

    std::size_t t() const { return 0; }
    std::size_t rate_eta() const { return q; }  ///< of x, then of t
    std::size_t rate_delta() const { return 2 * q + p; }
    std::size_t log_lambda_eta() const { return 2 * (p + q); }
    std::size_t log_lambda_delta() const { return log_lambda_eta() + 1; }
    std::size_t log_lambda_e() const { return log_lambda_eta() + 2; }
    std::size_t regression() const { return log_lambda_eta() + 3; }
    std::size_t beta() const { return log_lambda_eta() + 4; }  ///< of eta, then of delta
    std::size_t n_beta() const { return n_beta_eta + n_beta_delta; }
    std::size_t size() const { return beta() + n_beta(); }
};

Layout layout_of(const ModelOptions& options, std::size_t p, std::size_t q);

/// h(x). \param x  [p]   \param out  [number of coefficients]
void basis_of(Mean mean, const double* x, std::size_t p, double* out);
/// Of all rows: [n_beta x rows].
Matrix bases(Mean mean, std::size_t n_beta, const Matrix& x);

}  // namespace bemcal::emulator
