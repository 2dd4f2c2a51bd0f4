/// Normal random numbers by inversion.
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
