/// Where the temperatures of a ladder stand best.
#pragma once

#include <vector>

namespace bemcal::sampling {

/// Inverse temperatures between the same first and last, so that all neighbours refuse
/// swaps equally often: equal steps of the communication barrier, interpolated between
/// the present ones (Syed et al. 2022, arXiv:1905.02939, section 5.1, algorithm 3).
/// \param refused  [one fewer] share of swaps refused between neighbours
std::vector<double> equalised(const std::vector<double>& inverse_temperatures,
                              const std::vector<double>& refused);

}  // namespace bemcal::sampling
