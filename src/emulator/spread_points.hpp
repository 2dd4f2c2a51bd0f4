/// Points spread about a centre as a normal distribution is, and evenly: scrambled Sobol
/// points through the covariance's Cholesky factor, cut at 0 and 1.
#pragma once

#include "base/matrix.hpp"

#include <span>

namespace bemcal::emulator {

/// [n x parameters] \param covariance  [parameters x parameters] positive definite
Matrix spread_points(std::span<const double> centre, const Matrix& covariance,
                     std::size_t n);

}  // namespace bemcal::emulator
