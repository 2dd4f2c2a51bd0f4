/// Variances between and within chains, and what is made of their ratio.
///
/// Gelman and Rubin 1992 (doi:10.1214/ss/1177011136); the correction for the degrees of
/// freedom and the upper limit are those of the R package coda (gelman.diag, 0.19-4;
/// Brooks and Gelman 1998).
#pragma once

#include "base/matrix.hpp"

namespace bemcal::stats {

/// Of m chains of n draws; NaN for fewer than two chains or two draws.
struct GelmanRubin {
    double between = 0;    ///< B = n times the variance of the chains' means
    double within = 0;     ///< W, mean variance of a chain
    double variance = 0;   ///< sigma_+^2 = (n - 1)/n W + B/n
    double r = 0;          ///< paper 1, eq. 15: (m + 1)/m variance/W - (n - 1)/(m n)
    double corrected = 0;  ///< coda's point estimate of sqrt(r)
    double corrected_upper95 = 0;  ///< and the end of its one-sided 97.5 % interval
};

/// \param draws  [chains x draws]
GelmanRubin gelman_rubin_of(const Matrix& draws);

/// sqrt((B/W + n - 1) / n), of chains as they are; NaN where all draws are equal.
double basic_rhat(const Matrix& draws);

}  // namespace bemcal::stats
