/// Whether readings fall into a predictive sample as often as they should: coverage of
/// the central intervals, and the probability integral transform (Dawid 1984; Gneiting,
/// Balabdaoui and Raftery 2007, doi:10.1111/j.1467-9868.2007.00587.x).
///
/// Quantiles lie at the place p (draws + 1) of the sorted draws, so that a reading which
/// is one more draw falls between those of 5 and 95 % with the probability 0.9, however
/// few the draws are.
#pragma once

#include "base/matrix.hpp"

#include <array>
#include <span>

namespace bemcal::stats {

struct Coverage {
    double n = 0;          ///< readings compared
    double inside_50 = 0;  ///< share of them in the central 50 % interval; NaN for none
    double inside_90 = 0;  ///< and in the 90 % interval
};

/// \param observed  [n] NaN = missing   \param draws  [draws x n]
/// Readings of which a draw is not finite are left out.
Coverage coverage_of(std::span<const double> observed, const Matrix& draws);

constexpr std::size_t n_pit_bins = 20;

/// Histogram of each reading's rank among its draws, from below all to above all.
struct Pit {
    double n = 0;
    std::array<double, n_pit_bins> counts{};
    std::array<double, n_pit_bins> expected{};  ///< of calibrated draws: nearly all alike
    /// Largest difference of the two cumulative shares: 0.5 = all on one side.
    double distance = 0;
    double chi_square = 0;
    /// As if readings were independent. Neighbouring hours are not: a small value alone
    /// proves nothing, a large one is good.
    double p_value = 0;
};
Pit pit_of(std::span<const double> observed, const Matrix& draws);

/// At the place p (n + 1), within the ends; NaN of nothing.
double predictive_quantile(std::span<const double> sorted, double p);

}  // namespace bemcal::stats
