/// Puts readings of periods and meters one after the other.
/// Plain bookkeeping without a source; weights are by usual errors (`reading_noise`).
/// What was measured is not in it.
#include "study/series_layout.hpp"

#include "study/reading_noise.hpp"
#include "study/simulated_hours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bemcal::study {
namespace {

using emulator::ChannelRange;

/// Of a reading's error before the data: medians of the priors of residuals.
double usual_error(const Meter& meter) {
    return noise_scale(meter.quantity, meter.values) * usual_constant(meter.quantity);
}

}  // namespace

SeriesLayout::SeriesLayout(const Case& building, std::vector<std::size_t> meters)
    : meters_(std::move(meters)) {
    for (const Period& period : building.periods) {
        const physics::TimeAxis axis = axis_of(building, period);
        auto& ranges = ranges_.emplace_back();
        for (const std::size_t m : meters_) {
            const std::size_t n = begins_of(axis, building.meters[m].interval).size();
            ranges.push_back({size_, n});
            size_ += n;
        }
    }
}

const std::vector<ChannelRange>& SeriesLayout::ranges(const Case& building,
                                                      const Period& period) const {
    const auto found = std::ranges::find(building.periods, period.name, &Period::name);
    return ranges_.at(static_cast<std::size_t>(found - building.periods.begin()));
}

std::vector<double> SeriesLayout::series(
    const Case& building, const std::vector<std::vector<double>>& hours) const {
    std::vector<double> series;
    series.reserve(size_);
    for (const Period& period : building.periods)
        for (std::size_t c = 0; c < meters_.size(); ++c) {
            const Meter& meter = building.meters[meters_[c]];
            const auto own = readings_of_hours(
                building, period, {meter.quantity, meter.interval}, hours[c]);
            series.insert(series.end(), own.begin(), own.end());
        }
    return series;
}

std::vector<double> SeriesLayout::weights(const Case& building) const {
    std::vector<double> weights(size_);
    for (std::size_t c = 0; c < meters_.size(); ++c) {
        double n = 0;
        for (const auto& ranges : ranges_) n += static_cast<double>(ranges[c].size);
        const double weight =
            1 / (usual_error(building.meters[meters_[c]]) * std::sqrt(n));
        for (const auto& ranges : ranges_)
            for (std::size_t k = 0; k < ranges[c].size; ++k)
                weights[ranges[c].first + k] = weight;
    }
    return weights;
}

}  // namespace bemcal::study
