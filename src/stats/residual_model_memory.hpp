/// Log density of scaled residuals with a short memory alone: white, or AR(1). Over a gap
/// of g intervals the correlation is phi^g. Internal to the residual model.
#pragma once

#include "stats/residual_model_scale.hpp"

namespace bemcal::stats::residual {

/// phi^n by multiplication, and its derivative by phi.
struct Power {
    Lanes value, slope;
};
Power power_of(const Lanes& phi, std::size_t n);

/// Without the constants of 2 pi. Writes scaled.slope.
Lanes white_log_density(std::size_t n_present, const Scaled& scaled);

struct Ar1Density {
    Lanes value, by_phi;
};
/// Without the constants of 2 pi; stationary start. Writes scaled.slope.
Ar1Density ar1_log_density(const ReadingTimes& times, const Lanes& phi,
                           const Scaled& scaled);

}  // namespace bemcal::stats::residual
