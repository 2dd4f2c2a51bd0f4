/// Weighted least squares of a linearised model with a normal prior, and what it would
/// have said of readings it had not seen.
///
/// The model is r - J^T d: residuals r [n] (measured - predicted), derivatives J [p x n]
/// of the predictions, weights w [n] (0 = left out). Unknowns are in units of their prior
/// standard deviations, so the prior adds `prior` (1, or 0 where there is none) to the
/// diagonal of J w J^T.
#pragma once

#include "base/matrix.hpp"

#include <span>
#include <vector>

namespace bemcal::stats {

/// J w J^T [p x p] and J w r [p].
struct NormalEquations {
    Matrix matrix;
    std::vector<double> right;
};
NormalEquations normal_equations(const Matrix& derivatives, std::span<const double> r,
                                 std::span<const double> weights);

/// The same of a single derivative beside others: J w s [p], s w s and s w r.
struct Bordered {
    std::vector<double> with_others;
    double with_itself = 0, with_residual = 0;
};
Bordered bordered(const Matrix& derivatives, std::span<const double> s,
                  std::span<const double> r, std::span<const double> weights);

/// Solves (matrix + diagonal) d = right by LDL^T. Unknowns with fixed[k] keep d = 0.
std::vector<double> solve(const Matrix& matrix, std::span<const double> diagonal,
                          std::span<const double> right, std::span<const char> fixed);

/// Inverse of (matrix + diagonal); rows and columns of fixed unknowns are 0.
Matrix inverse(const Matrix& matrix, std::span<const double> diagonal,
               std::span<const char> fixed);

/// Residuals of each block of readings under the fit to all others: leave-one-block-out
/// without another simulation. At the fit J w r = prior pull, so leaving out block b
/// moves the unknowns by -(A - A_b)^-1 J_b w_b r_b.
/// \param block_of  [n] from 0; readings of weight 0 get their residual, too
std::vector<double> left_out_residuals(const Matrix& derivatives,
                                       std::span<const double> r,
                                       std::span<const double> weights,
                                       std::span<const int> block_of,
                                       std::span<const double> diagonal,
                                       std::span<const char> fixed);

}  // namespace bemcal::stats
