/// Normal random numbers by inversion: one uniform each, so that they are the same with
/// every library.
/// Source: textbook; the quantile is Boost's, by way of distributions. It is slower than
/// rejection methods.
#include "sampling/normal.hpp"

#include "stats/distributions.hpp"

namespace bemcal::sampling {

double standard_normal(Stream& random) {
    return stats::normal_quantile(random.uniform());
}

void fill_standard_normal(Stream& random, std::span<double> out) {
    for (double& z : out) z = standard_normal(random);
}

}  // namespace bemcal::sampling
