/// Normal random numbers from a stream: one uniform each, through the inverse of the
/// normal distribution function, so that they are the same on every platform's library.
#pragma once

#include "base/random.hpp"

#include <span>

namespace bemcal::sampling {

double standard_normal(Stream& random);
void fill_standard_normal(Stream& random, std::span<double> out);

}  // namespace bemcal::sampling
