/// Order among points with several objectives, all minimised (Deb, Pratap, Agarwal and
/// Meyarivan 2002, IEEE Trans. Evol. Comput. 6(2), section III).
#pragma once

#include "base/matrix.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace bemcal::optimise {

/// Whether a is nowhere worse than b and somewhere better.
bool dominates(std::span<const double> a, std::span<const double> b);

/// Rows of each front: 0 = dominated by none, 1 = by rows of front 0 only, ...; rising
/// within a front. \param objectives  [n x objectives]
std::vector<std::vector<std::size_t>> sort_into_fronts(const Matrix& objectives);

/// Crowding distance of the rows of one front: the sides of the box between neighbours,
/// over the front's extent; infinite at the ends of an objective. [front.size()]
std::vector<double> crowding_of(const Matrix& objectives,
                                std::span<const std::size_t> front);

}  // namespace bemcal::optimise
