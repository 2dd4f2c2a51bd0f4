/// A profile with few values in place of many: equally wide bins, each replaced by its
/// mean; one pass finds the means, a second one writes them.
/// Plain statistics without a source. Zeros stay zeros. Bins are not placed where they
/// would cost the least error, nor is that error told.
#include "effects/levels.hpp"

#include <algorithm>

namespace bemcal::effects {
namespace {

/// Whether there are more different values than `n`; stops where that is known.
bool has_more_values(const std::vector<double>& profile, std::size_t n) {
    std::vector<double> values;
    values.reserve(n + 1);
    for (const double value : profile) {
        if (std::ranges::find(values, value) != values.end()) continue;
        values.push_back(value);
        if (values.size() > n) return true;
    }
    return false;
}

struct Bins {
    double least = 0, width = 0;
    int count = 0;
    std::size_t of(double value) const {
        const int bin = static_cast<int>((value - least) / width);
        return static_cast<std::size_t>(std::clamp(bin, 0, count - 1));
    }
};

}  // namespace

std::vector<double> levelled(const std::vector<double>& profile, int n_levels) {
    if (!has_more_values(profile, static_cast<std::size_t>(n_levels))) return profile;
    const auto [least, most] = std::minmax_element(profile.begin(), profile.end());
    const Bins bins{*least, (*most - *least) / (n_levels - 1), n_levels - 1};
    std::vector<double> sum(static_cast<std::size_t>(bins.count)), n(sum.size());
    for (const double value : profile) {
        if (value == 0) continue;
        sum[bins.of(value)] += value;
        n[bins.of(value)] += 1;
    }
    std::vector<double> levels = profile;
    for (double& value : levels)
        if (value != 0) value = sum[bins.of(value)] / n[bins.of(value)];
    return levels;
}

}  // namespace bemcal::effects
