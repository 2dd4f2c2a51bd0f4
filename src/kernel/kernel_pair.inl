/// Two registers side by side as one vector: two independent chains of arithmetic hide
/// each other's latency.
/// Usual practice, without a source. It knows only what Register can do, one operation
/// each. Included in an unnamed namespace after the operations on Register (of `width`
/// doubles).

constexpr int lanes = 2 * width;

struct V {
    Register a, b;
};

inline V load(const double* at) {
    return {load_register(at), load_register(at + width)};
}
inline void store(double* at, V x) {
    store_register(at, x.a);
    store_register(at + width, x.b);
}
inline V broadcast(double value) {
    const Register x = broadcast_register(value);
    return {x, x};
}
inline V add(V x, V y) {
    return {add(x.a, y.a), add(x.b, y.b)};
}
inline V sub(V x, V y) {
    return {sub(x.a, y.a), sub(x.b, y.b)};
}
inline V mul(V x, V y) {
    return {mul(x.a, y.a), mul(x.b, y.b)};
}
inline V min(V x, V y) {
    return {min(x.a, y.a), min(x.b, y.b)};
}
inline V max(V x, V y) {
    return {max(x.a, y.a), max(x.b, y.b)};
}
inline V fma(V x, V y, V z) {
    return {fma(x.a, y.a, z.a), fma(x.b, y.b, z.b)};
}
inline V fms(V x, V y, V z) {
    return {fms(x.a, y.a, z.a), fms(x.b, y.b, z.b)};
}
inline V fnma(V x, V y, V z) {
    return {fnma(x.a, y.a, z.a), fnma(x.b, y.b, z.b)};
}
inline V positive_part(V x) {
    return {positive_part(x.a), positive_part(x.b)};
}
inline V negative_part(V x) {
    return {negative_part(x.a), negative_part(x.b)};
}
inline V magnitude(V x) {
    return {magnitude(x.a), magnitude(x.b)};
}

struct Mask {
    RegisterMask a, b;
};
inline Mask less(V x, V y) {
    return {less(x.a, y.a), less(x.b, y.b)};
}
inline Mask both(Mask x, Mask y) {
    return {both(x.a, y.a), both(x.b, y.b)};
}
inline bool all(Mask x) {
    return all(both(x.a, x.b));
}
/// x where the mask is set, else 0
inline V keep_where(Mask where, V x) {
    return {keep_where(where.a, x.a), keep_where(where.b, x.b)};
}
