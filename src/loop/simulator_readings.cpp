/// Sums hours (means of a temperature) over the intervals of each meter.
/// Plain bookkeeping without a source.
/// An interval that the period cuts has the hours that lie in it.
#include "loop/simulator_readings.hpp"

#include "base/nan.hpp"

#include <cmath>

namespace bemcal::loop {
namespace {

std::size_t n_hours(const study::Period& period) {
    return static_cast<std::size_t>(study::hours_of(period));
}

/// \param begins  of the intervals   \param from  of the first hour
std::vector<double> summed(const std::vector<double>& hours,
                           const std::vector<physics::Seconds>& begins,
                           physics::Seconds from, bool is_mean) {
    std::vector<double> sums(begins.size(), 0.0), n(begins.size(), 0.0);
    std::size_t at = 0;
    for (std::size_t h = 0; h < hours.size(); ++h) {
        const physics::Seconds begin = from + std::chrono::hours(h);
        while (at + 1 < begins.size() && begins[at + 1] <= begin) ++at;
        sums[at] += hours[h];
        n[at] += 1;
    }
    for (std::size_t k = 0; k < sums.size() && is_mean; ++k) sums[k] /= n[k];
    return sums;
}

}  // namespace

std::size_t hours_of_periods(const study::Case& building) {
    std::size_t n = 0;
    for (const study::Period& period : building.periods) n += n_hours(period);
    return n;
}

std::vector<double> hours_in(const study::Case& building, const study::Period& period,
                             const std::vector<double>& all) {
    std::size_t first = 0;
    for (const study::Period& each : building.periods) {
        if (each.name == period.name) break;
        first += n_hours(each);
    }
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(n_hours(period))};
}

std::vector<double> readings_from(const LoopData& data,
                                  const std::vector<std::vector<double>>& hours) {
    const study::Period& training = data.training();
    const physics::TimeAxis axis = study::axis_of(data.building, training);
    std::vector<double> readings;
    readings.reserve(data.targets.size());
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c) {
        const kernel::Channel& channel = data.targets.channels[c];
        const auto own = summed(hours_in(data.building, training, hours[c]),
                                study::begins_of(axis, channel.interval), training.from,
                                physics::is_temperature(channel.quantity));
        readings.insert(readings.end(), own.begin(), own.end());
    }
    return readings;
}

study::Case with_readings(const LoopData& data, std::span<const double> readings) {
    study::Case other = data.building;
    for (std::size_t c = 0; c < data.meters.size(); ++c) {
        study::Meter& meter = other.meters[data.meters[c]];
        for (std::size_t k = data.targets.first[c]; k < data.targets.first[c + 1]; ++k) {
            const int step = meter.axis.step_of(data.begins[k]);
            if (step < 0 || step >= meter.axis.n_steps) continue;
            double& value = meter.values[static_cast<std::size_t>(step)];
            if (!std::isnan(value)) value = readings[k];
        }
    }
    return other;
}

}  // namespace bemcal::loop
