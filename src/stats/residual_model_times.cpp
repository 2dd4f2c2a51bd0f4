/// When a meter was read: stretches of readings one interval apart, and the gap before
/// each.
/// Plain bookkeeping without a source. Time counts in whole intervals; uneven times are
/// left out.
#include "stats/residual_model_times.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stats {

namespace {

std::size_t place_of(std::size_t gap, std::vector<std::size_t>& gaps) {
    const auto found = std::find(gaps.begin() + 1, gaps.end(), gap);
    const auto place = static_cast<std::size_t>(found - gaps.begin());
    if (found == gaps.end()) gaps.push_back(gap);
    return place;
}

}  // namespace

ReadingTimes reading_times(std::span<const double> measured) {
    ReadingTimes times;
    times.gaps = {0, 1};
    std::size_t row = 0, count = 0, last = 0;
    const auto skip = [&](bool missing) {
        while (row < measured.size() && std::isnan(measured[row]) == missing) ++row;
        return row;
    };
    while (skip(true) < measured.size()) {
        const std::size_t first = row;
        const std::size_t length = skip(false) - first;
        const std::size_t gap =
            count == 0 ? ReadingTimes::start : place_of(first - last, times.gaps);
        times.stretches.push_back({count, count + length, first, gap});
        count += length;
        last = row - 1;
    }
    return times;
}

}  // namespace bemcal::stats
