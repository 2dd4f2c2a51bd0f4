/// How large errors of readings usually are, before the data.
#pragma once

#include "physics/quantities.hpp"

#include <span>

namespace bemcal::study {

/// The mean size of values that are not missing; a temperature strays by kelvins,
/// whatever it is.
double noise_scale(physics::Quantity quantity, std::span<const double> values);

/// The constant part of residuals before the data, as a share of that: its median.
double usual_constant(physics::Quantity quantity);

}  // namespace bemcal::study
