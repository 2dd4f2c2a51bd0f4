/// What a calibrated model says of the true process rho eta + delta and of measurements
/// of it, at points x, from draws of the posterior.
#pragma once

#include "base/random.hpp"
#include "emulator/density.hpp"

namespace bemcal::emulator {

/// In physical units; a row for each draw of the posterior.
struct Prediction {
    Matrix mean;         ///< [draws x points] of the true process, given the draw
    Matrix process;      ///< [draws x points] a draw of the true process, jointly
    Matrix measurement;  ///< [draws x points] a new measurement: process + noise
    /// [draws x coefficients] of the means, standardised: drawn where they are integrated
    /// out, the draw's own where they are sampled; without columns where there are none.
    Matrix coefficients;
};

/// \param draws  [draws x dimension] on the density's scale
/// \param x  [points x p] in physical units; at most some hundred: their joint covariance
/// is made for every draw
/// Throws std::domain_error where a draw's covariance is not positive definite.
Prediction predict(KohDensity& density, const Matrix& draws, const Matrix& x,
                   Stream& random);

}  // namespace bemcal::emulator
