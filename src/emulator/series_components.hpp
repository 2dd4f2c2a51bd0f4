/// Principal components of few long series: what a run has beyond the mean of the runs,
/// as a sum of a few series times the run's scores.
///
/// They are those of the series times the weights, found by the Gram matrix of the runs,
/// which is as small as the runs are few. Components are orthonormal in the weights:
/// sum_j weight_j^2 component_aj component_bj = 1 where a = b, else 0. So a score is in
/// standard deviations of a reading, as the weights have them, summed up over readings.
#pragma once

#include "base/matrix.hpp"

#include <span>
#include <vector>

namespace bemcal::emulator {

struct SeriesComponents {
    std::vector<double> mean;  ///< [n] of the runs
    Matrix components;         ///< [components x n]
    Matrix scores;             ///< [components x runs]
    Matrix gram;               ///< [runs x runs] of the weighted runs less their mean
    /// [runs x n] what the runs have beyond mean and components.
    Matrix remainder;
};

/// Of the runs' weighted variance: what is left out has 1 % of their standard deviation,
/// less than readings scatter about the best of models.
constexpr double usual_share = 0.9999;

/// \param series  [runs x n]   \param weights  [n]
/// \param share   of the runs' weighted variance that is kept at least
SeriesComponents components_of(Matrix series, std::span<const double> weights,
                               double share = usual_share);

}  // namespace bemcal::emulator
