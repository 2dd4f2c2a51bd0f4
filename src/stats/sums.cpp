/// Cuts readings into stretches that fit a cache, scales them by the roots of their
/// weights, and leaves the loops to the widest kernel that the processor can run.
/// Source: textbook sums. Leaves out compensation for rounding: sums of 1e5 readings lose
/// about 1e-13 of their size.
#include "stats/sums.hpp"

#include "stats/sums_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stats {
namespace {

const SumsKernel& kernel() {
#if defined(__x86_64__)
    static const SumsKernel& widest =
        __builtin_cpu_supports("avx2") ? sums_v3 : sums_plain;
    return widest;
#else
    return sums_plain;
#endif
}

}  // namespace

std::vector<double> products(const Rows& rows, std::span<const double> v) {
    std::vector<double> sums(rows.size(), 0.0);
    kernel().add_products(rows.data(), static_cast<long>(rows.size()), v.data(),
                          static_cast<long>(v.size()), sums.data());
    return sums;
}

std::vector<double> weighted_gram(const Rows& rows, std::span<const double> weights) {
    const std::size_t n_rows = rows.size(), n = weights.size();
    std::vector<double> sums(n_rows * n_rows, 0.0), scaled(n_rows * stretch),
        roots(stretch);
    for (std::size_t from = 0; from < n; from += stretch) {
        const auto own = weights.subspan(from, std::min<std::size_t>(stretch, n - from));
        if (std::ranges::all_of(own, [](double w) { return w == 0; })) continue;
        std::ranges::transform(own, roots.begin(), [](double w) { return std::sqrt(w); });
        if (own.size() < stretch) std::ranges::fill(scaled, 0.0);
        for (std::size_t r = 0; r < n_rows; ++r)
            for (std::size_t k = 0; k < own.size(); ++k)
                scaled[r * stretch + k] = roots[k] * rows[r][from + k];
        kernel().add_gram(scaled.data(), static_cast<long>(n_rows), sums.data());
    }
    for (std::size_t r = 0; r < n_rows; ++r)
        for (std::size_t s = r + 1; s < n_rows; ++s)
            sums[r * n_rows + s] = sums[s * n_rows + r];
    return sums;
}

}  // namespace bemcal::stats
