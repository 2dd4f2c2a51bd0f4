/// Variances between and within chains, and what is made of their ratio.
///
/// Gelman and Rubin 1992 (doi:10.1214/ss/1177011136).
#pragma once

#include "base/matrix.hpp"

namespace bemcal::stats {

/// Of m chains of n draws; NaN for fewer than two chains or two draws.
struct GelmanRubin {
    double between = 0;   ///< B = n times the variance of the chains' means
    double within = 0;    ///< W, mean variance of a chain
    double variance = 0;  ///< sigma_+^2 = (n - 1)/n W + B/n
    double r = 0;         ///< paper 1, eq. 15: (m + 1)/m variance/W - (n - 1)/(m n)
};

/// \param draws  [chains x draws]
GelmanRubin gelman_rubin_of(const Matrix& draws);

/// sqrt((B/W + n - 1) / n), of chains as they are; NaN where all draws are equal.
double basic_rhat(const Matrix& draws);

}  // namespace bemcal::stats
