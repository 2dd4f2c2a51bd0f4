/// The time loops one point at a time, with plain branches: the same bits as the vectors,
/// and what they are measured against.
/// Follows from kernel_reduce with V = double. Like all kernels it needs FMA; min and max
/// return what AVX returns of equals and NaN.
#include "kernel/kernel.hpp"

namespace bemcal::kernel {

namespace {

using V = double;
constexpr int lanes = 1;
constexpr bool many_registers = false;

inline V load(const double* at) {
    return *at;
}
inline void store(double* at, V x) {
    *at = x;
}
inline V broadcast(double value) {
    return value;
}
inline V add(V x, V y) {
    return x + y;
}
inline V sub(V x, V y) {
    return x - y;
}
inline V mul(V x, V y) {
    return x * y;
}
inline V positive_part(V x) {
    return x > 0 ? x : 0;
}
inline V negative_part(V x) {
    return x < 0 ? x : 0;
}
inline V min(V x, V y) {
    return x < y ? x : y;
}  // of equals or with a NaN: y, as in AVX
inline V max(V x, V y) {
    return x > y ? x : y;
}
inline V fma(V x, V y, V z) {
    return __builtin_fma(x, y, z);
}
inline V fms(V x, V y, V z) {
    return __builtin_fma(x, y, -z);
}
inline V fnma(V x, V y, V z) {
    return __builtin_fma(-x, y, z);
}
inline V magnitude(V x) {
    return __builtin_fabs(x);
}

using Mask = bool;
inline Mask less(V x, V y) {
    return x < y;
}
inline Mask both(Mask x, Mask y) {
    return x && y;
}
inline bool all(Mask x) {
    return x;
}
inline V keep_where(Mask where, V x) {
    return where ? x : 0;
}

#include "kernel/kernel_reduce.inl"

}  // namespace

const Table& scalar_table() {
    return table;
}

}  // namespace bemcal::kernel
