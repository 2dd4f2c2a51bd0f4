/// Cholesky elimination of a bordered symmetric matrix in blocks, by AVX and FMA:
/// determinant, Schur complement, and if wanted inverse and solutions.
/// Source: the symmetric Gauss-Jordan form of Cholesky, textbook. Without pivoting and in
/// one thread; it stops at a pivot that is rounding error.
#include "emulator/elimination.hpp"

#include "emulator/avx.hpp"

#include <math.h>

namespace bemcal::emulator {

namespace {

constexpr std::size_t widest = column_block;

/// Lower triangle of a block on the diagonal, its factor, and what divides by it.
struct Pivot {
    double l[widest][widest];
    double reciprocal[widest];
    double product;
};

bool factorise(const Bordered& a, std::size_t k, std::size_t width, double least,
               Pivot& pivot) {
    pivot.product = 1;
    for (std::size_t p = 0; p < width; ++p) {
        for (std::size_t q = 0; q <= p; ++q) {
            double sum = a.values[(k + p) * a.stride + k + q];
            for (std::size_t s = 0; s < q; ++s)
                sum = __builtin_fma(-pivot.l[p][s], pivot.l[q][s], sum);
            if (q < p) {
                pivot.l[p][q] = sum * pivot.reciprocal[q];
                continue;
            }
            if (!(sum > least)) return false;
            pivot.product *= sum;
            pivot.l[p][p] = sqrt(sum);
            pivot.reciprocal[p] = 1 / pivot.l[p][p];
        }
    }
    return true;
}

/// The block's columns of all other rows, transposed into the panel; zero in the block.
void gather(const Bordered& a, std::size_t k, std::size_t width, Eliminate what) {
    const std::size_t past = k + width;
    for (std::size_t p = 0; p < width; ++p) {
        double* to = a.panel + p * a.stride;
        const double* from = a.values + (k + p) * a.stride;
        if (what == Eliminate::fully)
            for (std::size_t i = 0; i < k; ++i) to[i] = from[i];
        for (std::size_t i = k; i < past; ++i) to[i] = 0;
    }
    for (std::size_t i = past; i < a.n_rows; ++i) {
        const double* from = a.values + i * a.stride + k;
        for (std::size_t p = 0; p < width; ++p) a.panel[p * a.stride + i] = from[p];
    }
}

/// panel <- L^-1 panel, in columns [from, to).
void divide_by_factor(const Bordered& a, const Pivot& pivot, std::size_t width,
                      std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; i += 4)
        for (std::size_t p = 0; p < width; ++p) {
            __m256d sum = _mm256_loadu_pd(a.panel + p * a.stride + i);
            for (std::size_t q = 0; q < p; ++q)
                sum = _mm256_fnmadd_pd(_mm256_set1_pd(pivot.l[p][q]),
                                       _mm256_loadu_pd(a.panel + q * a.stride + i), sum);
            _mm256_storeu_pd(a.panel + p * a.stride + i,
                             _mm256_mul_pd(sum, _mm256_set1_pd(pivot.reciprocal[p])));
        }
}

/// panel <- -L^-T panel, in columns [0, to).
void divide_by_transposed(const Bordered& a, const Pivot& pivot, std::size_t width,
                          std::size_t to) {
    const __m256d zero = _mm256_setzero_pd();
    for (std::size_t i = 0; i < to; i += 4)
        for (std::size_t p = width; p-- > 0;) {
            __m256d sum =
                _mm256_sub_pd(zero, _mm256_loadu_pd(a.panel + p * a.stride + i));
            for (std::size_t q = p + 1; q < width; ++q)
                sum = _mm256_fnmadd_pd(_mm256_set1_pd(pivot.l[q][p]),
                                       _mm256_loadu_pd(a.panel + q * a.stride + i), sum);
            _mm256_storeu_pd(a.panel + p * a.stride + i,
                             _mm256_mul_pd(sum, _mm256_set1_pd(pivot.reciprocal[p])));
        }
}

/// 4 rows x 8 columns of the matrix, less the product of their panels.
template <std::size_t width>
inline void subtract_tile(double* at, std::size_t stride, const double* left,
                          const double* right) {
    __m256d sums[4][2];
    for (std::size_t r = 0; r < 4; ++r) {
        sums[r][0] = _mm256_loadu_pd(at + r * stride);
        sums[r][1] = _mm256_loadu_pd(at + r * stride + 4);
    }
    for (std::size_t p = 0; p < width; ++p) {
        const __m256d first = _mm256_loadu_pd(right + p * stride);
        const __m256d second = _mm256_loadu_pd(right + p * stride + 4);
        for (std::size_t r = 0; r < 4; ++r) {
            const __m256d factor = _mm256_broadcast_sd(left + p * stride + r);
            sums[r][0] = _mm256_fnmadd_pd(factor, first, sums[r][0]);
            sums[r][1] = _mm256_fnmadd_pd(factor, second, sums[r][1]);
        }
    }
    for (std::size_t r = 0; r < 4; ++r) {
        _mm256_storeu_pd(at + r * stride, sums[r][0]);
        _mm256_storeu_pd(at + r * stride + 4, sums[r][1]);
    }
}

template <std::size_t width>
void subtract_products(const Bordered& a, std::size_t k, std::size_t from) {
    for (std::size_t i = from; i < a.n_rows; i += row_block) {
        if (i >= k && i < k + width) continue;
        for (std::size_t j = from; j < i + row_block; j += column_block)
            subtract_tile<width>(a.values + i * a.stride + j, a.stride, a.panel + i,
                                 a.panel + j);
    }
}

void keep_whitened(const Bordered& a, std::size_t k, std::size_t width) {
    for (std::size_t i = a.n_pivot; i < a.n_rows; ++i) {
        double* to = a.whitened + (i - a.n_pivot) * a.n_pivot + k;
        for (std::size_t p = 0; p < width; ++p) to[p] = a.panel[p * a.stride + i];
    }
}

/// The panel back into the block's rows and columns.
void scatter(const Bordered& a, std::size_t k, std::size_t width) {
    for (std::size_t p = 0; p < width; ++p) {
        double* to = a.values + (k + p) * a.stride;
        const double* from = a.panel + p * a.stride;
        for (std::size_t i = 0; i < k; ++i) to[i] = from[i];
    }
    for (std::size_t i = k + width; i < a.n_rows; ++i) {
        double* to = a.values + i * a.stride + k;
        for (std::size_t p = 0; p < width; ++p) to[p] = a.panel[p * a.stride + i];
    }
}

/// -(L L')^-1 in the place of the block.
void invert_block(const Bordered& a, std::size_t k, std::size_t width,
                  const Pivot& pivot) {
    double inverse[widest][widest] = {};  // of L
    for (std::size_t q = 0; q < width; ++q) {
        inverse[q][q] = pivot.reciprocal[q];
        for (std::size_t p = q + 1; p < width; ++p) {
            double sum = 0;
            for (std::size_t s = q; s < p; ++s)
                sum = __builtin_fma(-pivot.l[p][s], inverse[s][q], sum);
            inverse[p][q] = sum * pivot.reciprocal[p];
        }
    }
    for (std::size_t p = 0; p < width; ++p)
        for (std::size_t q = 0; q <= p; ++q) {
            double sum = 0;
            for (std::size_t s = p; s < width; ++s)
                sum = __builtin_fma(-inverse[s][p], inverse[s][q], sum);
            a.values[(k + p) * a.stride + k + q] = sum;
        }
}

}  // namespace

Eliminated eliminate(const Bordered& a, Eliminate what, double least_pivot) {
    Eliminated answer{true, 0};
    Pivot pivot;
    for (std::size_t k = 0, width = 0; k < a.n_pivot; k += width) {
        width = a.n_pivot - k < widest ? row_block : widest;
        if (!factorise(a, k, width, least_pivot, pivot)) return {false, 0};
        answer.log_determinant += log(pivot.product);
        const std::size_t from = what == Eliminate::fully ? 0 : k + width;
        gather(a, k, width, what);
        divide_by_factor(a, pivot, width, from, a.n_rows);
        width == widest ? subtract_products<widest>(a, k, from)
                        : subtract_products<row_block>(a, k, from);
        if (a.whitened != nullptr) keep_whitened(a, k, width);
        if (what == Eliminate::forward) continue;
        divide_by_transposed(a, pivot, width, a.n_rows);
        scatter(a, k, width);
        invert_block(a, k, width, pivot);
    }
    return answer;
}

}  // namespace bemcal::emulator
