/// Whether chains agree, and how many independent draws they are worth.
///
/// Gelman and Rubin 1992 (paper 1, eq. 14-15); split, rank-normalised and folded R-hat,
/// bulk and tail effective sample size and the Monte Carlo errors of Vehtari, Gelman,
/// Simpson, Carpenter and Burkner 2021 (doi:10.1214/20-BA1221), as the R package
/// posterior computes them (1.4).
#pragma once

#include "base/matrix.hpp"

namespace bemcal::stats {

/// NaN where a statistic is not defined: one chain, too few draws, all draws equal, a
/// draw that is not finite.
struct Convergence {
    double gelman_rubin = 0;  ///< eq. 15: R
    double rhat_split = 0, rhat_rank = 0;
    double ess_bulk = 0, ess_tail = 0, ess_mean = 0;
    double mean = 0, sd = 0;
    double mcse_mean = 0, mcse_sd = 0;
};

/// \param draws  [chains x draws] of one quantity
Convergence convergence_of(const Matrix& draws);

/// Effective sample size of the estimate of the quantile p.
double ess_of_quantile(const Matrix& draws, double p);

}  // namespace bemcal::stats
