/// Residuals divided by their scale, s^2 = (constant unit)^2 + (proportional f)^2, the
/// sum of -log s, and the way back through both.
/// Follows from that definition, differentiated by hand. Scales that depend on anything
/// else, as hour or season, are left out.
#include "stats/residual_model_scale.hpp"

namespace bemcal::stats::residual {

Lanes scale_residuals(const ReadingTimes& times, std::span<const double> measured,
                      const Scale& scale, const Block& block, const double* predictions,
                      const Scaled& scaled) {
    const Lanes constant = (scale.constant * scale.unit).square();
    const Lanes proportional = scale.proportional.square();
    LogProduct squares;
    for (const auto& stretch : times.stretches)
        for (std::size_t t = stretch.begin; t < stretch.end; ++t) {
            const std::size_t at = stretch.row + (t - stretch.begin);
            const Lanes f = block.load(predictions, at);
            const Lanes square = constant + proportional * f * f;
            squares.times(square);
            const Lanes inverse = square.inverse().sqrt();
            row(scaled.inverse_scale, t) = inverse;
            row(scaled.z, t) = (measured[at] - f) * inverse;
        }
    return -0.5 * squares.log();
}

// With a = 1 + z slope: d log s = (constant^2 d log constant + f^2 proportional^2
// (d log proportional + d log f)) / s^2 comes with -a, d f through y - f with -slope / s.
ScaleDerivative pull_back_scale(const ReadingTimes& times, const Scale& scale,
                                const Block& block, const double* predictions,
                                const Scaled& scaled, double* by_prediction) {
    const Lanes proportional = scale.proportional.square();
    Lanes sum = all(0), sum_of_squares = all(0);
    for (const auto& stretch : times.stretches)
        for (std::size_t t = stretch.begin; t < stretch.end; ++t) {
            const std::size_t at = stretch.row + (t - stretch.begin);
            const Lanes f = block.load(predictions, at);
            const Lanes inverse = row(scaled.inverse_scale, t);
            const Lanes slope = row(scaled.slope, t);
            const Lanes weight = (1 + slope * row(scaled.z, t)) * inverse * inverse;
            const Lanes weighted = weight * f;
            sum += weight;
            sum_of_squares += weighted * f;
            if (by_prediction)
                block.store(by_prediction, at,
                            -slope * inverse - proportional * weighted);
        }
    return {-sum * scale.constant * (scale.unit * scale.unit),
            -sum_of_squares * scale.proportional};
}

}  // namespace bemcal::stats::residual
