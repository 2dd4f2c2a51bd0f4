/// Means and variances of chains: what the statistics of convergence are made of.
#pragma once

#include "base/matrix.hpp"

#include <span>
#include <vector>

namespace bemcal::stats {

double mean_of(std::span<const double> values);
/// With n - 1; NaN for fewer than two.
double variance_of(std::span<const double> values);
/// Likewise.
double covariance_of(std::span<const double> a, std::span<const double> b);

struct ChainMoments {
    double n_draws = 0;
    std::vector<double> means, variances;  ///< [chains]
};
ChainMoments moments_of(const Matrix& draws);

/// Every draw is finite, and they are not all equal.
bool is_finite_and_varied(const Matrix& draws);

/// [2 chains x floor(draws / 2)]: the first and the last half of each chain; the middle
/// draw of an odd number is left out.
Matrix split_chains(const Matrix& draws);

}  // namespace bemcal::stats
