/// The squared-exponential covariance of Kennedy and O'Hagan 2001 (paper 1, eq. 9-10).
#pragma once

#include <span>

namespace bemcal::emulator {

/// exp(-sum_k beta_k (a_k - b_k)^2); rho_k = exp(-beta_k / 4) is what priors are on.
double correlation(std::span<const double> a, std::span<const double> b,
                   std::span<const double> beta);

}  // namespace bemcal::emulator
