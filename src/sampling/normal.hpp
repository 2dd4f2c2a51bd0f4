/// Normal random numbers from a stream: one uniform each, through the inverse of the
/// normal distribution function, so that they are the same on every platform's library.
#pragma once

#include "base/random.hpp"

#include <span>

namespace bemcal::sampling {

/// The standard normal's quantile, relative error about 1e-16 for 0 < p < 1: Wichura
/// 1988, algorithm AS 241 (PPND16), Applied Statistics 37(3), 477-484.
double normal_quantile(double p);

double standard_normal(Stream& random);
void fill_standard_normal(Stream& random, std::span<double> out);

}  // namespace bemcal::sampling
