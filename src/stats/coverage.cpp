/// Whether readings fall among their predictive draws as they should: shares inside
/// central intervals, and a histogram of ranks with its chi-square.
/// Source: Dawid 1984; Gneiting, Balabdaoui and Raftery 2007. Readings count as
/// independent, which neighbouring hours are not. A draw that is not finite leaves its
/// reading out.
#include "stats/coverage.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "stats/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bemcal::stats {
namespace {

/// f(reading, its sorted draws) for each reading that has all of its draws.
template <class F>
void for_each_reading(std::span<const double> observed, const Matrix& draws, F f) {
    require(draws.rows == 0 || draws.cols == observed.size(),
            "as many columns of draws as readings");
    std::vector<double> column(draws.rows);
    for (std::size_t k = 0; k < observed.size() && draws.rows > 0; ++k) {
        if (std::isnan(observed[k])) continue;
        for (std::size_t d = 0; d < draws.rows; ++d) column[d] = draws(d, k);
        if (!std::ranges::all_of(column, [](double x) { return std::isfinite(x); }))
            continue;
        std::ranges::sort(column);
        f(observed[k], column);
    }
}

/// Draws below a reading; of those equal to it, half.
std::size_t rank_in(const std::vector<double>& sorted, double reading) {
    const auto equal = std::ranges::equal_range(sorted, reading);
    return static_cast<std::size_t>(equal.begin() - sorted.begin()) + equal.size() / 2;
}

std::size_t bin_of(std::size_t rank, std::size_t n_draws) {
    return n_pit_bins * rank / (n_draws + 1);
}

void expect_uniform(Pit& pit, std::size_t n_draws) {
    for (std::size_t rank = 0; rank <= n_draws; ++rank)
        pit.expected[bin_of(rank, n_draws)] += pit.n / static_cast<double>(n_draws + 1);
}

/// Bins that no rank falls into (fewer than 19 draws) do not count.
void compare(Pit& pit) {
    double difference = 0, n_bins = 0;
    for (std::size_t bin = 0; bin < n_pit_bins; ++bin) {
        const double excess = pit.counts[bin] - pit.expected[bin];
        difference += excess / pit.n;
        pit.distance = std::max(pit.distance, std::abs(difference));
        if (pit.expected[bin] == 0) continue;
        pit.chi_square += excess * excess / pit.expected[bin];
        n_bins += 1;
    }
    const Distribution chi_square{Family::gamma, (n_bins - 1) / 2, 0.5};
    pit.p_value = chi_square.upper(pit.chi_square);
}

}  // namespace

double predictive_quantile(std::span<const double> sorted, double p) {
    if (sorted.empty()) return nan;
    const double last = static_cast<double>(sorted.size() - 1);
    const double place = std::clamp(p * (last + 2) - 1, 0.0, last);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] +
           (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Coverage coverage_of(std::span<const double> observed, const Matrix& draws) {
    double n = 0, inside_50 = 0, inside_90 = 0;
    for_each_reading(observed, draws, [&](double x, const std::vector<double>& sorted) {
        const double least = predictive_quantile(sorted, 0.05);
        const double most = predictive_quantile(sorted, 0.95);
        n += 1;
        inside_90 += x >= least && x <= most;
        inside_50 += x >= predictive_quantile(sorted, 0.25) &&
                     x <= predictive_quantile(sorted, 0.75);
    });
    if (n == 0) return {0, nan, nan};
    return {n, inside_50 / n, inside_90 / n};
}

Pit pit_of(std::span<const double> observed, const Matrix& draws) {
    Pit pit;
    for_each_reading(observed, draws, [&](double x, const std::vector<double>& sorted) {
        pit.n += 1;
        pit.counts[bin_of(rank_in(sorted, x), sorted.size())] += 1;
    });
    if (pit.n == 0) {
        pit.distance = pit.chi_square = pit.p_value = nan;
        return pit;
    }
    expect_uniform(pit, draws.rows);
    compare(pit);
    return pit;
}

}  // namespace bemcal::stats
