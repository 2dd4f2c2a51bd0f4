/// Readings scaled: z = (y - f) / s with s^2 = (constant unit)^2 + (proportional f)^2,
/// and the way back through it. Internal to the residual model.
#pragma once

#include "stats/residual_model_lanes.hpp"
#include "stats/residual_model_times.hpp"

#include <span>

namespace bemcal::stats::residual {

struct Scale {
    Lanes constant, proportional;
    double unit = 1;  ///< of the constant part
};

/// Scratch [n_present x width].
struct Scaled {
    double* z;
    double* inverse_scale;
    double* slope;  ///< d log density of the z / d z
};

/// Writes z and 1/s. Returns the sum of -log s.
Lanes scale_residuals(const ReadingTimes& times, std::span<const double> measured,
                      const Scale& scale, const Block& block, const double* predictions,
                      const Scaled& scaled);

struct ScaleDerivative {
    Lanes constant, proportional;
};

/// From the slope by z to those by prediction and by the scale's parameters.
/// \param by_prediction  [readings x lanes], or nullptr; missing readings are left alone
ScaleDerivative pull_back_scale(const ReadingTimes& times, const Scale& scale,
                                const Block& block, const double* predictions,
                                const Scaled& scaled, double* by_prediction);

}  // namespace bemcal::stats::residual
