/// Saltelli's design: A and B are the halves of a 2 d-dimensional Sobol point; AB_i is A
/// with column i from B.
/// Source: Saltelli et al. 2010, Comput. Phys. Commun. 181. Left out: second-order
/// indices, and scaling to ranges or priors, which is the caller's.
#include "stats/saltelli.hpp"

#include "stats/sobol_sequence.hpp"

#include <algorithm>

namespace bemcal::stats {

Matrix saltelli_points(std::size_t first, std::size_t n, int dimension, bool scramble,
                       std::uint64_t seed) {
    const auto d = static_cast<std::size_t>(dimension);
    const Matrix base = scramble ? scrambled_sobol_points(first, n, 2 * dimension, seed)
                                 : sobol_points(first, n, 2 * dimension);
    Matrix design(n * (d + 2), d);
    for (std::size_t j = 0; j < n; ++j) {
        const auto a = base.row(j).first(d), b = base.row(j).last(d);
        for (std::size_t r = 0; r < d + 2; ++r)
            std::ranges::copy(r <= d ? a : b, design.row(j * (d + 2) + r).begin());
        for (std::size_t i = 0; i < d; ++i) design(j * (d + 2) + 1 + i, i) = b[i];
    }
    return design;
}

}  // namespace bemcal::stats
