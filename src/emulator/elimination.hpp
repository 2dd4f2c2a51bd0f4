/// Cholesky elimination of a symmetric matrix bordered by further rows, in blocks.
///
///     [ K   . ]                       [ -K^-1      .           ]
///     [ R   S ]   -- eliminate -->    [ -R K^-1    S - R K^-1 R' ]
///
/// Everything a Gaussian process needs is in the result: inverse, solutions, conditional
/// covariance, quadratic forms. It is one Cholesky factorisation in which the rows of an
/// identity matrix ride along in the place of columns that are done with (the symmetric
/// Gauss-Jordan form), so that value and derivatives share their operations bit by bit.
/// Not LAPACK: OpenBLAS chooses its operations by processor, and bits are to be the same.
/// Compiled for AVX and FMA, without anything from the standard library.
#pragma once

#include <cstddef>

namespace bemcal::emulator {

enum class Eliminate {
    forward,  ///< the lower right block, the whitened rows and the determinant only
    fully     ///< and the inverse and the solutions
};

/// Lower triangles, row by row; what stands above the diagonal is scratch, but finite.
/// Rows and pivots are whole numbers of `row_block`: fill up with the identity.
struct Bordered {
    double* values;       ///< [rows x stride]
    std::size_t stride;   ///< >= rows + column_block, a multiple of column_block
    std::size_t n_pivot;  ///< rows of K
    std::size_t n_rows;   ///< of K and R
    double* panel;        ///< scratch [column_block x stride], zero beyond n_rows
    double* whitened;     ///< R L^-T  [n_rows - n_pivot x n_pivot], or nullptr
};

constexpr std::size_t row_block = 4, column_block = 8;

struct Eliminated {
    bool is_definite;        ///< false: a pivot was not above the least one
    double log_determinant;  ///< of K
};

/// \param least_pivot  of the factorisation; what is not above it is rounding error
Eliminated eliminate(const Bordered& matrix, Eliminate what, double least_pivot);

}  // namespace bemcal::emulator
