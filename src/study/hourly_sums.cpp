/// A vector of four lanes is one register with AVX2 and two without; the sums are the
/// same.
#include "study/hourly_sums.hpp"

#include "physics/batch.hpp"

#include <algorithm>

namespace bemcal::study {
namespace {

typedef double Quad __attribute__((vector_size(32), aligned(8), may_alias));

/// Rows of a width that the compiler knows.
template <std::size_t width>
struct Lanes {
    explicit Lanes(const Rows& rows)
        : first(rows.first), second(rows.first + rows.to_second) {}
    [[gnu::always_inline]] Quad& quad(std::size_t k, std::size_t step) const {
        double* table = 4 * k < width ? first : second;
        return *reinterpret_cast<Quad*>(table + step * width + 4 * k % width);
    }
    double *first, *second;
};

/// Adds to sums[0..3] the four lanes of each vector, one vector for each step.
[[gnu::always_inline]] inline void add_lanes(double* sums, const Quad& s0, const Quad& s1,
                                             const Quad& s2, const Quad& s3) {
    const Quad t01 = __builtin_shufflevector(s0, s1, 0, 4, 2, 6) +
                     __builtin_shufflevector(s0, s1, 1, 5, 3, 7);
    const Quad t23 = __builtin_shufflevector(s2, s3, 0, 4, 2, 6) +
                     __builtin_shufflevector(s2, s3, 1, 5, 3, 7);
    *reinterpret_cast<Quad*>(sums) += __builtin_shufflevector(t01, t23, 0, 1, 4, 5) +
                                      __builtin_shufflevector(t01, t23, 2, 3, 6, 7);
}

struct Terms {
    Quad first, second, third;
};

/// Sum of a, of b, of a^2 + b^2; shifts b in place.
template <std::size_t width>
struct Base {
    Lanes<width> rows_a, rows_b;
    const double* shift;
    [[gnu::always_inline]] Terms operator()(std::size_t step) const {
        Quad a[4], b[4];
        for (std::size_t k = 0; k < 4; ++k) {
            a[k] = rows_a.quad(k, step) - shift[step];
            rows_b.quad(k, step) = b[k] = rows_b.quad(k, step) - shift[step];
        }
        return {(a[0] + a[1]) + (a[2] + a[3]), (b[0] + b[1]) + (b[2] + b[3]),
                ((a[0] * a[0] + b[0] * b[0]) + (a[1] * a[1] + b[1] * b[1])) +
                    ((a[2] * a[2] + b[2] * b[2]) + (a[3] * a[3] + b[3] * b[3]))};
    }
};

/// Sum of b (ab - a), of ab - a, of (ab - a)^2.
template <std::size_t width>
struct Mixed {
    Lanes<width> a, b, ab;
    [[gnu::always_inline]] Terms operator()(std::size_t step) const {
        const Quad d0 = ab.quad(0, step) - a.quad(0, step);
        const Quad d1 = ab.quad(1, step) - a.quad(1, step);
        const Quad d2 = ab.quad(2, step) - a.quad(2, step);
        const Quad d3 = ab.quad(3, step) - a.quad(3, step);
        return {(b.quad(0, step) * d0 + b.quad(1, step) * d1) +
                    (b.quad(2, step) * d2 + b.quad(3, step) * d3),
                (d0 + d1) + (d2 + d3), (d0 * d0 + d1 * d1) + (d2 * d2 + d3 * d3)};
    }
};

struct Sums {
    double *first, *second, *third;
};

[[gnu::always_inline]] inline void add_four(const Sums& sums, std::size_t step,
                                            const Terms& t0, const Terms& t1,
                                            const Terms& t2, const Terms& t3) {
    add_lanes(sums.first + step, t0.first, t1.first, t2.first, t3.first);
    add_lanes(sums.second + step, t0.second, t1.second, t2.second, t3.second);
    add_lanes(sums.third + step, t0.third, t1.third, t2.third, t3.third);
}

/// By value, so that the compiler sees that no sum overlaps them.
template <class Source>
[[gnu::always_inline]] inline void add_steps(const Source source, std::size_t n,
                                             const Sums sums) {
    for (std::size_t step = 0; step < n; step += 4)
        add_four(sums, step, source(step), source(step + 1), source(step + 2),
                 source(step + 3));
}

template <class Source>
[[gnu::target("avx2")]] void add_with_avx2(const Source& source, std::size_t n,
                                           const Sums& sums) {
    add_steps(source, n, sums);
}

template <class Source>
void add(const Source& source, std::size_t n, const Sums& sums, bool with_avx2) {
    if (with_avx2)
        add_with_avx2(source, n, sums);
    else
        add_steps(source, n, sums);
}

}  // namespace

HourlySums::HourlySums(std::size_t dimension, std::size_t n_steps)
    : dimension_(dimension),
      n_steps_(n_steps),
      padded_((n_steps + 3) / 4 * 4),
      with_avx2_(physics::choose_instruction_set() != physics::InstructionSet::scalar),
      sums_(n_terms(dimension) * padded_, 0.0) {}

void HourlySums::add_base(std::size_t begin, std::size_t n, const Rows& a, const Rows& b,
                          const double* shift) {
    const Sums sums{term(0, begin), term(1, begin), term(2, begin)};
    if (a.width == 16)
        add(Base<16>{Lanes<16>(a), Lanes<16>(b), shift}, n, sums, with_avx2_);
    else
        add(Base<8>{Lanes<8>(a), Lanes<8>(b), shift}, n, sums, with_avx2_);
}

void HourlySums::add_mixed(std::size_t begin, std::size_t n, std::size_t i, const Rows& a,
                           const Rows& b, const Rows& ab) {
    const std::size_t d = dimension_;
    const Sums sums{term(3 + i, begin), term(3 + d + i, begin),
                    term(3 + 2 * d + i, begin)};
    if (a.width == 16)
        add(Mixed<16>{Lanes<16>(a), Lanes<16>(b), Lanes<16>(ab)}, n, sums, with_avx2_);
    else
        add(Mixed<8>{Lanes<8>(a), Lanes<8>(b), Lanes<8>(ab)}, n, sums, with_avx2_);
}

std::vector<double> HourlySums::values() const {
    const std::size_t n = n_terms(dimension_);
    std::vector<double> values(n * n_steps_);
    for (std::size_t row = 0; row < n; ++row)
        for (std::size_t step = 0; step < n_steps_; ++step)
            values[step * n + row] = sums_[row * padded_ + step];
    return values;
}

StepEstimate estimate(std::span<const double> sums, double n) {
    const std::size_t d = (sums.size() - 3) / 3;
    const auto product = sums.subspan(3, d), difference = sums.subspan(3 + d, d),
               square = sums.subspan(3 + 2 * d, d);
    StepEstimate found;
    double total = sums[0] + sums[1];
    for (const double sum : difference) total += sums[0] + sum;
    found.mean = total / (n * static_cast<double>(d + 2));
    const double mean_a_b = (sums[0] + sums[1]) / (2 * n);
    found.variance = sums[2] / (2 * n) - mean_a_b * mean_a_b;
    found.parts.resize(2 * d);
    for (std::size_t i = 0; i < d; ++i) {
        found.parts[i] = (product[i] - found.mean * difference[i]) / n;
        found.parts[d + i] = square[i] / (2 * n);
    }
    return found;
}

}  // namespace bemcal::study
