/// Weighted least squares of a linearised model with a normal prior, and how far the
/// unknowns are known.
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

/// The same of several at once, time after time: the derivatives are read once for all of
/// them, where they are larger than any cache.
class Borders {
  public:
    Borders(const Matrix& derivatives, std::span<const double> r,
            std::span<const double> weights);

    /// \param s  [any] rows of [n]
    std::vector<Bordered> of(const std::vector<const double*>& s) const;

  private:
    Matrix weighted_;  ///< [p + 1 x n] J w, r w
    std::vector<double> weights_;
};

/// Solves (matrix + diagonal) d = right by LDL^T. Unknowns with fixed[k] keep d = 0.
std::vector<double> solve(const Matrix& matrix, std::span<const double> diagonal,
                          std::span<const double> right, std::span<const char> fixed);

/// Inverse of (matrix + diagonal); rows and columns of fixed unknowns are 0.
Matrix inverse(const Matrix& matrix, std::span<const double> diagonal,
               std::span<const char> fixed);

/// Standard deviations of the unknowns by leaving out block after block of readings:
/// unlike the inverse they see how a model that is not quite true fits some blocks
/// otherwise than others (delete-a-block jackknife: Kuensch 1989, Annals of Statistics
/// 17). Nothing is fitted again: at the fit J w r = prior pull, so leaving out block b
/// moves the unknowns by
/// -(A - A_b)^-1 J_b w_b r_b.
/// \param block_of  [n] from 0
/// \return [p], 0 of those that are fixed or of which one block tells more than half
std::vector<double> jackknife_deviations(const Matrix& derivatives,
                                         std::span<const double> r,
                                         std::span<const double> weights,
                                         std::span<const int> block_of,
                                         std::span<const double> diagonal,
                                         std::span<const char> fixed);

}  // namespace bemcal::stats
