/// Temperatures at equal steps of the communication barrier, interpolated between the
/// present ones.
/// Source: Syed et al. 2022, section 5.1, algorithm 3; geometric between neighbours,
/// linear down to 0. The ends and their number stay.
#include "sampling/temperatures.hpp"

#include <cmath>
#include <numeric>

namespace bemcal::sampling {
namespace {

/// Geometric, as the barrier of a normal likelihood grows; linear down to 0.
double between(double cold, double hot, double share) {
    return hot > 0 ? cold * std::pow(hot / cold, share) : cold * (1 - share);
}

}  // namespace

std::vector<double> equalised(const std::vector<double>& inverse_temperatures,
                              const std::vector<double>& refused) {
    const double barrier = std::accumulate(refused.begin(), refused.end(), 0.0);
    std::vector<double> equal = inverse_temperatures;
    if (!(barrier > 0)) return equal;
    const double step = barrier / static_cast<double>(refused.size());
    std::size_t i = 0;
    double before = 0;  // barrier from the first to the i-th
    for (std::size_t k = 1; k + 1 < equal.size(); ++k) {
        const double wanted = step * static_cast<double>(k);
        while (i + 1 < refused.size() && before + refused[i] < wanted)
            before += refused[i++];
        const double share = refused[i] > 0 ? (wanted - before) / refused[i] : 0;
        equal[k] = between(inverse_temperatures[i], inverse_temperatures[i + 1], share);
    }
    return equal;
}

}  // namespace bemcal::sampling
