/// Scales of errors by what is read.
/// Both are judgement: the medians of a posterior's priors.
/// Errors that remember each other are left to the residual model.
#include "study/reading_noise.hpp"

#include <cmath>

namespace bemcal::study {

double noise_scale(physics::Quantity quantity, std::span<const double> values) {
    if (physics::is_temperature(quantity)) return 1;
    double sum = 0, n = 0;
    for (const double value : values)
        if (!std::isnan(value)) sum += std::abs(value), n += 1;
    return sum > 0 ? sum / n : 1;
}

double usual_constant(physics::Quantity quantity) {
    return physics::is_temperature(quantity) ? 0.5 : 0.1;
}

}  // namespace bemcal::study
