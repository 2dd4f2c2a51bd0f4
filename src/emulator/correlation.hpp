/// The squared-exponential correlation of paper 1, eq. 9-10, many points at once:
/// exp(-sum_k rate_k (a_k - b_k)^2), where the eq. write beta for the rates.
///
/// Compiled for AVX and FMA, without anything from the standard library.
#pragma once

#include <cstddef>

namespace bemcal::emulator {

/// The next multiple of 4.
constexpr std::size_t in_fours(std::size_t n) {
    return (n + 3) / 4 * 4;
}

/// Points as columns: coordinate k of point j is values[k * stride + j].
struct PointTable {
    const double* values;  ///< [dimension x stride], finite up to a multiple of 4
    std::size_t stride, dimension;
};

/// Correlations of a point with the first n of a table.
/// \param point  coordinate k is point[k * step]
/// \param out  [n, rounded up to a multiple of 4]
void correlate(const double* point, std::size_t step, const PointTable& table,
               std::size_t n, const double* rates, double* out);

/// Adds sum_j weight_j (a_k - b_jk)^2 to sums[k].
/// \param weights  [n, rounded up to a multiple of 4], zero from n on
void add_weighted_squares(const double* point, std::size_t step, const PointTable& table,
                          std::size_t n, const double* weights, double* sums);

}  // namespace bemcal::emulator
