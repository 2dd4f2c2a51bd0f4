/// A quantile of a sorted sample, in proportion between its neighbours.
/// Source: type 7 of Hyndman and Fan 1996. It does not sort and takes no weights;
/// predictive intervals take another place (coverage).
#include "stats/quantile.hpp"

#include "base/nan.hpp"

#include <algorithm>

namespace bemcal::stats {

double quantile_of_sorted(std::span<const double> sorted, double p) {
    if (sorted.empty()) return nan;
    const double place = p * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    const double share = place - static_cast<double>(below);
    return sorted[below] + share * (sorted[above] - sorted[below]);
}

}  // namespace bemcal::stats
