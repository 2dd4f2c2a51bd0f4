/// A full factorial over the parameters of a simulator, and its refinement by midpoints.
#pragma once

#include "base/matrix.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace bemcal::calibration {

/// Rising values of every parameter; one value = it is held there.
using Grid = std::vector<std::vector<double>>;

/// Points of the grid; saturates below the largest number.
std::size_t size_of(const Grid& grid);

/// Points [first, first + n) of the product, the last parameter running fastest.
/// \return [n x parameters]
Matrix points_of(const Grid& grid, std::size_t first, std::size_t n);

/// Where a parameter's new values may lie.
struct Room {
    double least = 0, most = 0;
    bool has_midpoints = true;  ///< not where only its given values make sense
};

/// The values kept, with the midpoints to their neighbours on the axis; at its ends the
/// missing neighbour is half a step outside, unless the room ends before it. An axis of
/// one value has no neighbours.
/// \param kept  some of the axis's values, rising
std::vector<double> with_midpoints(const std::vector<double>& axis,
                                   const std::vector<double>& kept, const Room& room);

}  // namespace bemcal::calibration
