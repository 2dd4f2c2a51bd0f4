/// Saltelli's design and the Sobol indices estimated from it.
///
/// Estimators: Saltelli et al. 2010, Comput. Phys. Commun. 181, table 2 (b) and (f), on
/// outputs standardised over the whole design:
///     S1 = mean(B (AB - A)) / var
///     ST = mean((A - AB)^2) / (2 var)
#pragma once

#include "base/matrix.hpp"

#include <cstdint>
#include <vector>

namespace bemcal::stats {

/// Rows for base points [first, first + n): for each A, AB_1 .. AB_d, B, in [0, 1).
/// \return [n (d + 2) x d]
Matrix saltelli_points(std::size_t first, std::size_t n, int dimension, bool scramble,
                       std::uint64_t seed);

struct SobolIndices {
    std::vector<double> first_order, total_order;  ///< [d]; NaN for a constant output
    std::vector<double> first_half_width, total_half_width;  ///< [d] of the 95 % interval
    double mean = 0, variance = 0;
    int n_used = 0;           ///< base points without a failed row
    bool degenerate = false;  ///< the output does not vary
};

/// Indices of one output. A base point with a NaN among its rows is left out, whole.
/// \param outputs  [n_base (d + 2)] in the row order of saltelli_points
/// \param n_bootstrap  resamplings of base points for the half widths; 0 = none
SobolIndices sobol_indices(const std::vector<double>& outputs, int dimension,
                           int n_bootstrap, std::uint64_t seed);

}  // namespace bemcal::stats
