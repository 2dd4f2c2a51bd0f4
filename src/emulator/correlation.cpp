/// Squared-exponential correlations of a point with many, four at a time by AVX and FMA,
/// with an exponential of its own.
/// Source: paper 1, eq. 9-10; Taylor's series after reduction by ln 2. Other correlations
/// are left out; below exp(-708) nothing gets smaller.
#include "emulator/correlation.hpp"

#include "emulator/avx.hpp"

namespace bemcal::emulator {

namespace {

/// 1/k!, falling: the Taylor series on |r| <= ln 2 / 2 ends below 1e-17.
constexpr double series[] = {1.0 / 6227020800,
                             1.0 / 479001600,
                             1.0 / 39916800,
                             1.0 / 3628800,
                             1.0 / 362880,
                             1.0 / 40320,
                             1.0 / 5040,
                             1.0 / 720,
                             1.0 / 120,
                             1.0 / 24,
                             1.0 / 6,
                             1.0 / 2,
                             1,
                             1};

inline __m128i shifted(__m128d rounded) {
    return _mm_slli_epi64(_mm_castpd_si128(rounded), 52);
}

inline __m128d scaled(__m128d x, __m128d rounded) {
    return _mm_castsi128_pd(_mm_add_epi64(_mm_castpd_si128(x), shifted(rounded)));
}

/// 2^n exp(r) with x = n ln 2 + r.
inline __m256d exponential(__m256d x) {
    const __m256d magic = _mm256_set1_pd(0x1.8p52);
    x = _mm256_max_pd(x, _mm256_set1_pd(-708));
    const __m256d rounded =
        _mm256_fmadd_pd(x, _mm256_set1_pd(0x1.71547652b82fep0), magic);
    const __m256d n = _mm256_sub_pd(rounded, magic);
    __m256d r = _mm256_fnmadd_pd(n, _mm256_set1_pd(0x1.62e42fefa39efp-1), x);
    r = _mm256_fnmadd_pd(n, _mm256_set1_pd(0x1.abc9e3b39803fp-56), r);
    __m256d sum = _mm256_set1_pd(series[0]);
    for (std::size_t k = 1; k < sizeof series / sizeof *series; ++k)
        sum = _mm256_fmadd_pd(sum, r, _mm256_set1_pd(series[k]));
    return _mm256_set_m128d(
        scaled(_mm256_extractf128_pd(sum, 1), _mm256_extractf128_pd(rounded, 1)),
        scaled(_mm256_castpd256_pd128(sum), _mm256_castpd256_pd128(rounded)));
}

inline double total(__m256d x) {
    const __m128d pair =
        _mm_add_pd(_mm256_castpd256_pd128(x), _mm256_extractf128_pd(x, 1));
    return _mm_cvtsd_f64(pair) + _mm_cvtsd_f64(_mm_unpackhi_pd(pair, pair));
}

}  // namespace

void correlate(const double* point, std::size_t step, const PointTable& table,
               std::size_t n, const double* rates, double* out) {
    for (std::size_t j = 0; j < n; j += 4) {
        __m256d sum = _mm256_setzero_pd();
        for (std::size_t k = 0; k < table.dimension; ++k) {
            const __m256d difference =
                _mm256_sub_pd(_mm256_set1_pd(point[k * step]),
                              _mm256_loadu_pd(table.values + k * table.stride + j));
            sum = _mm256_fnmadd_pd(_mm256_mul_pd(difference, difference),
                                   _mm256_set1_pd(rates[k]), sum);
        }
        _mm256_storeu_pd(out + j, exponential(sum));
    }
}

void add_weighted_squares(const double* point, std::size_t step, const PointTable& table,
                          std::size_t n, const double* weights, double* sums) {
    for (std::size_t k = 0; k < table.dimension; ++k) {
        const __m256d at = _mm256_set1_pd(point[k * step]);
        __m256d sum = _mm256_setzero_pd();
        for (std::size_t j = 0; j < n; j += 4) {
            const __m256d difference =
                _mm256_sub_pd(at, _mm256_loadu_pd(table.values + k * table.stride + j));
            sum = _mm256_fmadd_pd(_mm256_mul_pd(difference, difference),
                                  _mm256_loadu_pd(weights + j), sum);
        }
        sums[k] += total(sum);
    }
}

}  // namespace bemcal::emulator
