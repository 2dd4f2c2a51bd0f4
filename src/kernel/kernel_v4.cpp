/// The time loops for x86-64-v4: AVX-512, 2 x 8 lanes; columns that every step needs stay
/// in its 32 registers.
/// Source: Intel's intrinsics; the loops are kernel_reduce's. Left out: whether the
/// processor can run it, which instruction_set tells.
#include "kernel/kernel.hpp"

#include <immintrin.h>

namespace bemcal::kernel {

namespace {

using Register = __m512d;
constexpr int width = 8;
constexpr bool many_registers = true;

inline Register load_register(const double* at) {
    return _mm512_loadu_pd(at);
}
inline void store_register(double* at, Register x) {
    _mm512_storeu_pd(at, x);
}
inline Register broadcast_register(double value) {
    return _mm512_set1_pd(value);
}
inline Register add(Register x, Register y) {
    return _mm512_add_pd(x, y);
}
inline Register sub(Register x, Register y) {
    return _mm512_sub_pd(x, y);
}
inline Register mul(Register x, Register y) {
    return _mm512_mul_pd(x, y);
}
// With a full mask: the plain ones have an operand in GCC 12 that it then warns of.
inline Register min(Register x, Register y) {
    return _mm512_maskz_min_pd(0xFF, x, y);
}
inline Register max(Register x, Register y) {
    return _mm512_maskz_max_pd(0xFF, x, y);
}
inline Register fma(Register x, Register y, Register z) {
    return _mm512_fmadd_pd(x, y, z);
}
inline Register fms(Register x, Register y, Register z) {
    return _mm512_fmsub_pd(x, y, z);
}
inline Register fnma(Register x, Register y, Register z) {
    return _mm512_fnmadd_pd(x, y, z);
}
inline Register magnitude(Register x) {
    return _mm512_abs_pd(x);
}

// As integers, whose sign is the same, and in other units of the processor.
inline Register positive_part(Register x) {
    return _mm512_castsi512_pd(
        _mm512_maskz_max_epi64(0xFF, _mm512_castpd_si512(x), _mm512_setzero_si512()));
}
inline Register negative_part(Register x) {
    return _mm512_castsi512_pd(
        _mm512_maskz_min_epi64(0xFF, _mm512_castpd_si512(x), _mm512_setzero_si512()));
}

using RegisterMask = __mmask8;
inline RegisterMask less(Register x, Register y) {
    return _mm512_cmp_pd_mask(x, y, _CMP_LT_OQ);
}
inline RegisterMask both(RegisterMask x, RegisterMask y) {
    return _kand_mask8(x, y);
}
inline bool all(RegisterMask x) {
    return x == 0xff;
}
inline Register keep_where(RegisterMask where, Register x) {
    return _mm512_maskz_mov_pd(where, x);
}

#include "kernel/kernel_pair.inl"
#include "kernel/kernel_reduce.inl"

}  // namespace

const Table& v4_table() {
    return table;
}

}  // namespace bemcal::kernel
