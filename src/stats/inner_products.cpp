/// Inner products in tiles of four rows times three, by AVX and FMA: a tile's sums stay
/// in registers, and a stretch of all rows stays in the cache. Source: Goto and van de
/// Geijn 2008 (ACM TOMS 34), without packing: rows are contiguous. Products of floats are
/// summed as floats over a stretch, then as doubles. Nothing is saved where a and b are
/// the same rows.
#include "stats/inner_products.hpp"

#include <immintrin.h>
#include <math.h>

namespace bemcal::stats {
namespace {

constexpr std::size_t tall = 4, wide = 3;  ///< of a tile
constexpr std::size_t stretch = 512;       ///< numbers of a row that are summed at once

/// Eight floats or four doubles at once.
struct Floats {
    using Number = float;
    using Register = __m256;
    static constexpr std::size_t lanes = 8;
    static Register zero() { return _mm256_setzero_ps(); }
    static Register load(const float* at) { return _mm256_loadu_ps(at); }
    static Register fma(Register x, Register y, Register z) {
        return _mm256_fmadd_ps(x, y, z);
    }
    static float fma(float x, float y, float z) { return __builtin_fmaf(x, y, z); }
    static double total(Register sums) {
        const __m256d low = _mm256_cvtps_pd(_mm256_castps256_ps128(sums)),
                      high = _mm256_cvtps_pd(_mm256_extractf128_ps(sums, 1));
        double all[4];
        _mm256_storeu_pd(all, _mm256_add_pd(low, high));
        return (all[0] + all[1]) + (all[2] + all[3]);
    }
};
struct Doubles {
    using Number = double;
    using Register = __m256d;
    static constexpr std::size_t lanes = 4;
    static Register zero() { return _mm256_setzero_pd(); }
    static Register load(const double* at) { return _mm256_loadu_pd(at); }
    static Register fma(Register x, Register y, Register z) {
        return _mm256_fmadd_pd(x, y, z);
    }
    static double fma(double x, double y, double z) { return __builtin_fma(x, y, z); }
    static double total(Register sums) {
        double all[4];
        _mm256_storeu_pd(all, sums);
        return (all[0] + all[1]) + (all[2] + all[3]);
    }
};

/// The rows of a tile from a number on; beyond the last it stands again.
template <class Number, std::size_t n>
struct Some {
    const Number* rows[n];
    std::size_t count;  ///< of them that are there

    Some(const NumberRows<Number>& all, std::size_t first, std::size_t from)
        : count(all.count - first < n ? all.count - first : n) {
        for (std::size_t k = 0; k < n; ++k)
            rows[k] =
                all.values + (first + (k < count ? k : count - 1)) * all.stride + from;
    }
};

template <class Lanes, std::size_t columns>
void add_tile(const Some<typename Lanes::Number, tall>& a,
              const Some<typename Lanes::Number, columns>& b, std::size_t n,
              std::size_t stride, double* to) {
    typename Lanes::Register sums[tall][columns];
    for (auto& row : sums)
        for (auto& sum : row) sum = Lanes::zero();
    std::size_t k = 0;
    for (; k + Lanes::lanes <= n; k += Lanes::lanes)
        for (std::size_t j = 0; j < columns; ++j) {
            const auto of_b = Lanes::load(b.rows[j] + k);
            for (std::size_t i = 0; i < tall; ++i)
                sums[i][j] = Lanes::fma(Lanes::load(a.rows[i] + k), of_b, sums[i][j]);
        }
    for (std::size_t i = 0; i < a.count; ++i)
        for (std::size_t j = 0; j < b.count; ++j) {
            typename Lanes::Number rest = 0;
            for (std::size_t r = k; r < n; ++r)
                rest = Lanes::fma(a.rows[i][r], b.rows[j][r], rest);
            to[i * stride + j] += Lanes::total(sums[i][j]) + static_cast<double>(rest);
        }
}

template <class Lanes, std::size_t columns>
void add_tiles(const NumberRows<typename Lanes::Number>& a,
               const NumberRows<typename Lanes::Number>& b, std::size_t n, double* to) {
    using Number = typename Lanes::Number;
    for (std::size_t from = 0; from < n; from += stretch) {
        const std::size_t size = n - from < stretch ? n - from : stretch;
        for (std::size_t j = 0; j < b.count; j += columns) {
            const Some<Number, columns> of_b(b, j, from);
            for (std::size_t i = 0; i < a.count; i += tall)
                add_tile<Lanes, columns>(Some<Number, tall>(a, i, from), of_b, size,
                                         b.count, to + i * b.count + j);
        }
    }
}

template <class Lanes>
void add_all(const NumberRows<typename Lanes::Number>& a,
             const NumberRows<typename Lanes::Number>& b, std::size_t n, double* to) {
    if (b.count < wide)
        add_tiles<Lanes, 1>(a, b, n, to);
    else
        add_tiles<Lanes, wide>(a, b, n, to);
}

}  // namespace

void add_inner_products(const NumberRows<double>& a, const NumberRows<double>& b,
                        std::size_t n, double* to) {
    add_all<Doubles>(a, b, n, to);
}

void add_inner_products(const NumberRows<float>& a, const NumberRows<float>& b,
                        std::size_t n, double* to) {
    add_all<Floats>(a, b, n, to);
}

}  // namespace bemcal::stats
