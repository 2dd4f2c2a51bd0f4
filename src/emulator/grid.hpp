/// Whether simulator runs are a full grid: every design t at the same points x. Then
/// their covariance is exactly a Kronecker product.
#pragma once

#include "emulator/runs.hpp"

#include <optional>

namespace bemcal::emulator {

struct Grid {
    Matrix t;                              ///< [designs x q]
    Matrix x;                              ///< [points x p]
    Matrix output;                         ///< [designs x points]
    std::vector<std::size_t> of_measured;  ///< [n] the point of each measurement
};

/// Inputs that differ by no more than this, on the scale 0 to 1, are the same.
constexpr double grid_tolerance = 1e-8;

/// The runs in any order; nothing where they are no grid, or a measurement lies beside
/// it.
std::optional<Grid> find_grid(const Observations& standardised,
                              double tolerance = grid_tolerance);

}  // namespace bemcal::emulator
