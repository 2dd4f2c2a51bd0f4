/// Reads hours as the channels of a loop, and puts readings in place of others.
/// Plain bookkeeping without a source.
/// A reading that is missing stays so.
#include "loop/simulator_readings.hpp"

#include "study/simulated_hours.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
std::vector<double> readings_from(const LoopData& data,
                                  const std::vector<std::vector<double>>& hours) {
    std::vector<double> readings;
    readings.reserve(data.targets.size());
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c) {
        const auto own = study::readings_of_hours(data.building, data.training(),
                                                  data.targets.channels[c], hours[c]);
        readings.insert(readings.end(), own.begin(), own.end());
    }
    return readings;
}

std::size_t place_of_training(const LoopData& data) {
    const auto& periods = data.building.periods;
    const auto found =
        std::ranges::find(periods, data.training().name, &study::Period::name);
    return static_cast<std::size_t>(found - periods.begin());
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
