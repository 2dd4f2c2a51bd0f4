#include "emulator/covariance.hpp"

#include <cmath>

namespace bemcal::emulator {

double correlation(std::span<const double> a, std::span<const double> b,
                   std::span<const double> beta) {
    double sum = 0;
    for (std::size_t k = 0; k < beta.size(); ++k)
        sum += beta[k] * (a[k] - b[k]) * (a[k] - b[k]);
    return std::exp(-sum);
}

}  // namespace bemcal::emulator
