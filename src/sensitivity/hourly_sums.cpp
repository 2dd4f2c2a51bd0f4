/// Adds sixteen points up, step by step, in an order that is written out, so that the
/// bits are the same with AVX2 (a register of four) and without (two of two); estimates
/// indices from the sums.
/// Source: Saltelli et al. 2010, table 2 (b) and (f).
/// Intervals are in `hourly_indices`, the points' way through time in `hourly_block`.
#include "sensitivity/hourly_sums.hpp"

#include <array>

namespace bemcal::sensitivity {
namespace {

typedef double Quad __attribute__((vector_size(32), aligned(8), may_alias));

std::size_t in_fours(std::size_t n) {
    return (n + 3) / 4 * 4;
}

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

/// As an answer: a bare vector of this size is passed in a way of its own with AVX.
struct Four {
    Quad lanes;
};

/// Where the sums of each group of points are.
using Groups = std::array<const double*, sixteen>;

/// Sums of a row ([3 x steps]) of points 4 q to 4 q + 3.
template <std::size_t lanes>
[[gnu::always_inline]] inline Four four(const Groups& groups, std::size_t row,
                                        std::size_t q) {
    if constexpr (lanes < 4) {
        const double* const* point = groups.data() + 4 * q;
        return {Quad{point[0][row], point[1][row], point[2][row], point[3][row]}};
    } else {
        const double* first = groups[4 * q / lanes] + row * lanes + 4 * q % lanes;
        return {*reinterpret_cast<const Quad*>(first)};
    }
}

template <std::size_t lanes>
[[gnu::always_inline]] inline Four sixteen_in_four(const Groups& groups,
                                                   std::size_t row) {
    return {(four<lanes>(groups, row, 0).lanes + four<lanes>(groups, row, 1).lanes) +
            (four<lanes>(groups, row, 2).lanes + four<lanes>(groups, row, 3).lanes)};
}

/// The three sums of n steps, each to a series of its own.
using Series = std::array<double*, 3>;

template <std::size_t lanes>
[[gnu::always_inline]] inline void add_steps(const Groups groups, std::size_t n,
                                             const Series series) {
    for (std::size_t step = 0; step < n; step += 4)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t row = 3 * step + k;
            add_lanes(series[k] + step, sixteen_in_four<lanes>(groups, row).lanes,
                      sixteen_in_four<lanes>(groups, row + 3).lanes,
                      sixteen_in_four<lanes>(groups, row + 6).lanes,
                      sixteen_in_four<lanes>(groups, row + 9).lanes);
        }
}

// Elsewhere the kernel has one lane, and nothing gets there.
#if defined(__x86_64__)
#define BEMCAL_WITH_AVX2 [[gnu::target("avx2")]]
#else
#define BEMCAL_WITH_AVX2
#endif

template <std::size_t lanes>
BEMCAL_WITH_AVX2 void add_with_avx2(const Groups& groups, std::size_t n,
                                    const Series& series) {
    add_steps<lanes>(groups, n, series);
}

void add(const LaneSums& sums, std::size_t n, const Series& series) {
    Groups groups{};
    for (std::size_t k = 0; k < sums.n_groups(); ++k) groups[k] = sums.group(k);
    switch (sums.lanes()) {
        case 8:
            return add_with_avx2<8>(groups, n, series);
        case sixteen:
            return add_with_avx2<sixteen>(groups, n, series);
        default:
            return add_steps<1>(groups, n, series);
    }
}

}  // namespace

LaneSums::LaneSums(std::size_t lanes, std::size_t n_steps) : lanes_(lanes) {
    for (std::size_t k = 0; k < sixteen / lanes; ++k)
        groups_.emplace_back(3 * in_fours(n_steps), static_cast<int>(lanes));
}

void LaneSums::clear() {
    for (LaneArray& group : groups_) group.clear();
}

HourlySums::HourlySums(std::size_t dimension, std::size_t n_steps)
    : dimension_(dimension),
      n_steps_(n_steps),
      padded_(in_fours(n_steps)),
      sums_(n_terms(dimension) * padded_, 0.0) {}

void HourlySums::add_base(std::size_t begin, std::size_t n, const LaneSums& sums) {
    add(sums, n, {term(0, begin), term(1, begin), term(2, begin)});
}

void HourlySums::add_input(std::size_t i, std::size_t begin, std::size_t n,
                           const LaneSums& sums) {
    const std::size_t d = dimension_;
    add(sums, n,
        {term(3 + i, begin), term(3 + d + i, begin), term(3 + 2 * d + i, begin)});
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

}  // namespace bemcal::sensitivity
