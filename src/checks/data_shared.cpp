/// Whether two series are one: the median ratio of their readings, and how many keep it
/// within rounding and 0.1 %. A sample of readings spares most pairs the rest.
/// Our own rule, without a source. Left out: sums of several meters, shifted series, and
/// a share that changes.
#include "checks/data_shared.hpp"

#include "checks/data_readings.hpp"

#include <algorithm>
#include <vector>

namespace bemcal::checks {

namespace {

constexpr int least_readings = 168;
constexpr double least_variation = 1.2;  ///< ninth decile / first decile
constexpr double most_rounding = 0.1;    ///< of a reading; coarser ones tell nothing
constexpr double least_rounding = 1e-3;

/// Usual distance between neighbouring values; rounding twice leaves some much closer.
double usual_gap(std::span<const double> values) {
    std::vector<double> sorted;
    for (const double value : values)
        if (value > 0) sorted.push_back(value);
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> gaps;
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (const double gap = sorted[i] - sorted[i - 1]; gap > 1e-9 * sorted[i])
            gaps.push_back(gap);
    return gaps.empty() ? 0 : quantile_of(std::move(gaps), 0.25);
}

struct Pair {
    double first, second;
    double rounding;  ///< of their ratio, relative
};

std::vector<Pair> pairs_of(std::span<const double> first,
                           std::span<const double> second) {
    const double half_first = usual_gap(first) / 2, half_second = usual_gap(second) / 2;
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < std::min(first.size(), second.size()); ++k) {
        if (!(first[k] > 0 && second[k] > 0)) continue;  // NaN fails as well
        const double rounding = half_first / first[k] + half_second / second[k];
        if (rounding < most_rounding)
            pairs.push_back({first[k], second[k], rounding + least_rounding});
    }
    return pairs;
}

/// Whether two series can be one, from every hundredth or so of their readings; spares
/// most pairs of many the sorting of all.
bool can_be_one(std::span<const double> first, std::span<const double> second) {
    const std::size_t n = std::min(first.size(), second.size());
    const std::size_t stride = std::max<std::size_t>(n / 500, 1);
    std::vector<double> ratios;
    for (std::size_t k = 0; k < n; k += stride)
        if (first[k] > 0 && second[k] > 0) ratios.push_back(second[k] / first[k]);
    const double middle = quantile_of(ratios, 0.5);
    const auto near = std::ranges::count_if(
        ratios, [&](double r) { return std::abs(r / middle - 1) < most_rounding; });
    return 2 * near >= static_cast<std::ptrdiff_t>(ratios.size());
}

}  // namespace

Proportion proportion_of(std::span<const double> first, std::span<const double> second) {
    if (!can_be_one(first, second)) return {};
    const std::vector<Pair> pairs = pairs_of(first, second);
    if (pairs.size() < least_readings) return {};
    std::vector<double> ratios, values;
    ratios.reserve(pairs.size());
    values.reserve(pairs.size());
    for (const Pair& pair : pairs) {
        ratios.push_back(pair.second / pair.first);
        values.push_back(pair.first);
    }
    if (quantile_of(values, 0.9) < least_variation * quantile_of(values, 0.1)) return {};
    const double ratio = quantile_of(std::move(ratios), 0.5);
    const auto n = std::count_if(pairs.begin(), pairs.end(), [&](const Pair& pair) {
        return std::abs(pair.second / pair.first / ratio - 1) <= pair.rounding;
    });
    return {static_cast<int>(pairs.size()), ratio,
            static_cast<double>(n) / static_cast<double>(pairs.size())};
}

}  // namespace bemcal::checks
