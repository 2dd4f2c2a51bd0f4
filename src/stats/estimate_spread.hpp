/// How far parameters that were fitted by least squares may be off, from the residuals
/// they leave.
///
/// The covariance of the ordinary estimate where residuals follow each other:
/// (J'J)^-1 J' S J (J'J)^-1, S being the covariance of a first-order autoregression with
/// the residuals' own variance and lag-one correlation (White 1980's sandwich with a
/// parametric middle). A flat range [0, 1] of each parameter is taken in as a normal of
/// its variance, 1/12, so that a parameter the data say nothing of has that. Left out:
/// curvature, and correlation among series.
#pragma once

#include "base/matrix.hpp"

#include <span>
#include <vector>

namespace bemcal::stats {

constexpr double flat_variance = 1.0 / 12;  ///< of a flat range [0, 1]

/// Residuals that follow each other in time, and their derivatives by each parameter.
struct ResidualSeries {
    std::vector<double> residuals;  ///< [n]; NaN = no reading
    Matrix derivatives;             ///< [parameters x n] by shares of the range
};

/// Lag-one correlation over neighbours that both are read, 0 to 0.999.
double lag_one_correlation(std::span<const double> residuals);

/// Standard deviations as shares of the ranges, at most sqrt(1/12). [parameters]
std::vector<double> estimate_spread(std::span<const ResidualSeries> series,
                                    std::size_t n_parameters);

}  // namespace bemcal::stats
