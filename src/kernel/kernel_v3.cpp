/// The time loops for x86-64-v3: AVX2 and FMA, 2 x 4 lanes.
/// Source: Intel's intrinsics; the loops are kernel_reduce's. Left out: whether the
/// processor can run it, which instruction_set tells.
#include "kernel/kernel.hpp"

#include <immintrin.h>

namespace bemcal::kernel {

namespace {

using Register = __m256d;
constexpr int width = 4;
constexpr bool many_registers = false;

inline Register load_register(const double* at) {
    return _mm256_loadu_pd(at);
}
inline void store_register(double* at, Register x) {
    _mm256_storeu_pd(at, x);
}
inline Register broadcast_register(double value) {
    return _mm256_set1_pd(value);
}
inline Register add(Register x, Register y) {
    return _mm256_add_pd(x, y);
}
inline Register sub(Register x, Register y) {
    return _mm256_sub_pd(x, y);
}
inline Register mul(Register x, Register y) {
    return _mm256_mul_pd(x, y);
}
inline Register min(Register x, Register y) {
    return _mm256_min_pd(x, y);
}
inline Register max(Register x, Register y) {
    return _mm256_max_pd(x, y);
}
inline Register fma(Register x, Register y, Register z) {
    return _mm256_fmadd_pd(x, y, z);
}
inline Register fms(Register x, Register y, Register z) {
    return _mm256_fmsub_pd(x, y, z);
}
inline Register fnma(Register x, Register y, Register z) {
    return _mm256_fnmadd_pd(x, y, z);
}
inline Register magnitude(Register x) {
    return _mm256_and_pd(x, _mm256_castsi256_pd(_mm256_set1_epi64x(0x7fffffffffffffff)));
}

inline Register positive_part(Register x) {
    return max(x, _mm256_setzero_pd());
}
inline Register negative_part(Register x) {
    return min(x, _mm256_setzero_pd());
}

using RegisterMask = __m256d;
inline RegisterMask less(Register x, Register y) {
    return _mm256_cmp_pd(x, y, _CMP_LT_OQ);
}
inline RegisterMask both(RegisterMask x, RegisterMask y) {
    return _mm256_and_pd(x, y);
}
inline bool all(RegisterMask x) {
    return _mm256_movemask_pd(x) == 0xf;
}
inline Register keep_where(RegisterMask where, Register x) {
    return _mm256_and_pd(where, x);
}

#include "kernel/kernel_pair.inl"
#include "kernel/kernel_reduce.inl"

}  // namespace

const Table& v3_table() {
    return table;
}

}  // namespace bemcal::kernel
