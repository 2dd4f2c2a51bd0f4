/// Sobol points (Joe and Kuo 2008) and their scrambling.
#pragma once

#include "base/matrix.hpp"

#include <cstdint>

namespace bemcal::stats {

constexpr int max_sobol_dimension = 3667;

/// Points [first, first + n) of the sequence that starts with the zero point, in [0, 1).
/// Unscrambled points equal SciPy's qmc.Sobol(scramble=False) bit for bit.
Matrix sobol_points(std::size_t first, std::size_t n, int dimension);

/// The same with a random linear matrix scramble and a digital shift (Matousek 1998), a
/// pure function of the seed; any block of points can be made anywhere.
Matrix scrambled_sobol_points(std::size_t first, std::size_t n, int dimension,
                              std::uint64_t seed);

}  // namespace bemcal::stats
