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

/// \param series  [runs x n]   \param weights  [n]
SeriesComponents components_of(Matrix series, std::span<const double> weights);

}  // namespace bemcal::emulator
