/// Simulation-based calibration (Talts et al. 2018, arXiv:1804.06788): over many fits of
/// data drawn from the model itself, the rank of the truth among posterior draws is
/// uniform.
#pragma once

#include "stats/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bemcal::test {

/// p-value of Pearson's chi-square against uniform ranks 0 ... n_ranks, in `n_bins` bins
/// of equal width (n_ranks + 1 is a multiple of them).
inline double uniformity_p(const std::vector<int>& ranks, int n_ranks, int n_bins) {
    std::vector<double> counts(static_cast<std::size_t>(n_bins), 0);
    for (const int rank : ranks)
        counts[static_cast<std::size_t>(rank * n_bins / (n_ranks + 1))] += 1;
    const double expected = static_cast<double>(ranks.size()) / n_bins;
    double chi_square = 0;
    for (const double count : counts)
        chi_square += (count - expected) * (count - expected) / expected;
    return stats::Distribution{stats::Family::gamma, 0.5 * (n_bins - 1), 0.5}.upper(
        chi_square);
}

/// Holm's step-down: the least p-value times its number of hypotheses, and so on; a
/// family is rejected at a level where the least of these is below it.
inline double least_holm_p(std::vector<double> p_values) {
    std::ranges::sort(p_values);
    return std::min(1.0, p_values[0] * static_cast<double>(p_values.size()));
}

/// How many of evenly thinned draws lie below the truth.
inline int rank_of(double truth, const std::vector<double>& draws, int n_ranks) {
    int rank = 0;
    for (int k = 0; k < n_ranks; ++k) {
        const std::size_t at = static_cast<std::size_t>(k) * draws.size() /
                               static_cast<std::size_t>(n_ranks);
        if (draws[at] < truth) ++rank;
    }
    return rank;
}

}  // namespace bemcal::test
