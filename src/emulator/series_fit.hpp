/// The parameters of an external simulator from a measured series, through an emulator of
/// it: maximum a posteriori, and its covariance.
///
/// Readings are the emulated series plus independent errors of standard deviation
/// 1 / weight, plus the emulator's own error: each score is normal about its process'
/// mean, with one variance V_c for all points. V_c is the mean of the process' variances
/// over points spread about the optimum by the covariance itself; at first, by the
/// priors. So fit and spread are found in rounds, until they agree. Then
///
///     objective = r' C^-1 r / 2 + sum ((x - mean) / sd)^2 / 2,  C = 1 + B V B',
///     r = weights (measured - emulated),  B = weights components,
///
/// and the covariance is the inverse of the Gauss-Newton matrix of this objective:
/// J' B' C^-1 B J + 1 / sd^2 with J the scores' derivatives. As a series is linear in its
/// scores, all of this is as large as scores and parameters, not as readings.
/// Source: Higdon, Gattiker, Williams and Rightley 2008, without a discrepancy: a model
/// that is not true is more certain here than it ought to be. Weights are the place to
/// say so: fewer independent readings, larger standard deviations.
#pragma once

#include "emulator/series_emulator.hpp"

namespace bemcal::emulator {

/// Normal, of a parameter on the scale 0 to 1, and cut there. With sd = 1 it is nearly
/// uniform.
struct ScaledPrior {
    double mean = 0.5, sd = 1;
};

struct SeriesFit {
    std::vector<double> point;  ///< [parameters]
    /// Of the parameters as if they had no bounds. [parameters x parameters]
    Matrix covariance;
    double objective_before = 0;            ///< at the best of the runs' points
    double objective_after = 0;             ///< at the optimum
    std::vector<double> emulator_variance;  ///< V [components]
    int n_rounds = 0;
};

/// \param measured  [n] NaN = missing
/// \param weights   [n] 1 / standard deviation of a reading's error; 0 = left out
/// \param priors    [parameters]
/// Throws std::invalid_argument: lengths that do not fit, no reading with a weight,
/// weights or priors that are not possible.
SeriesFit fit_series(const SeriesEmulator& emulator, std::span<const double> measured,
                     std::span<const double> weights,
                     std::span<const ScaledPrior> priors);

/// Where the next runs of the simulator pay: the optimum first, then points about it as
/// the covariance has them, cut at the bounds. [n x parameters]
Matrix next_points(const SeriesFit& fit, std::size_t n);

}  // namespace bemcal::emulator
