/// Cuts hours of all periods to one, and reads them by the intervals of each meter.
/// Plain bookkeeping without a source.
/// An interval that the period cuts has the hours that lie in it.
#include "loop/simulator_readings.hpp"

#include "loop/months.hpp"

#include <cmath>

namespace bemcal::loop {
namespace {

std::size_t n_hours(const study::Period& period) {
    return static_cast<std::size_t>(study::hours_of(period));
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
    const auto begins = study::begins_of(axis, physics::Interval::hourly);
    std::vector<double> readings;
    readings.reserve(data.targets.size());
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c) {
        const kernel::Channel& channel = data.targets.channels[c];
        const auto own =
            over_intervals(begins, hours_in(data.building, training, hours[c]),
                           study::begins_of(axis, channel.interval),
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
