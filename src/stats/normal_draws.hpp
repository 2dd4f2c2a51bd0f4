/// Draws of a normal distribution.
#pragma once

#include "base/matrix.hpp"

#include <cstdint>

namespace bemcal::stats {

/// Draws of mean 0 with this covariance, [n + 1 x p]; the first is the mean itself.
/// Deterministic in the seed. Directions without variance, and those that rounding makes
/// negative, have none.
/// \param covariance  [p x p] symmetric
Matrix normal_draws(const Matrix& covariance, std::size_t n, std::uint64_t seed);

}  // namespace bemcal::stats
