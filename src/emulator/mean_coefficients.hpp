/// Generalised least squares for the coefficients beta of the means: with the flat prior
/// they are normal with precision Q = H'K^-1 H and mean Q^-1 H'K^-1 z, and integrating
/// them out costs -log |Q| / 2 (Rasmussen and Williams 2006, eq. 2.42-2.45).
#pragma once

#include "base/matrix.hpp"
#include "emulator/bordered_matrix.hpp"

#include <vector>

namespace bemcal::emulator {

class MeanCoefficients {
  public:
    MeanCoefficients(std::size_t n, bool are_given)
        : precision(n, n), right_side(n), beta(n), given_(are_given), work_(n, 1) {}

    std::size_t size() const { return beta.size(); }
    /// Q, H'K^-1 z and beta, if given, are set by the caller. False: Q is not positive
    /// definite.
    bool solve(const double* given_beta);
    /// To be added to the log likelihood at beta = 0.
    double log_likelihood() const;
    /// Rows Q^-1 R. \param rows  [size() x stride], the first n columns of each
    void times_inverse(const Matrix& rows, Matrix& out) const;

    Matrix precision;                ///< Q [k x k], both triangles
    std::vector<double> right_side;  ///< H'K^-1 z
    std::vector<double> beta;
    Matrix inverse;  ///< Q^-1; 0 where beta is given: it is certain
  private:
    bool given_;
    double log_determinant_ = 0;
    BorderedMatrix work_;
};

}  // namespace bemcal::emulator
