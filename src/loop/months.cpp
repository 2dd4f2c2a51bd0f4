/// Adds hours up by year and month.
/// Plain bookkeeping without a source. A month without a reading is left out.
#include "loop/months.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace bemcal::loop {

Months months_of(const std::vector<physics::Seconds>& begins,
                 std::span<const double> simulated, std::span<const double> measured,
                 bool is_mean) {
    std::map<std::pair<int, int>, std::array<double, 3>> sums;
    for (std::size_t k = 0; k < begins.size(); ++k) {
        if (std::isnan(measured[k])) continue;
        const auto step = physics::calendar_step(begins[k]);
        auto& [s, m, n] = sums[{step.year, step.month}];
        s += simulated[k], m += measured[k], n += 1;
    }
    Months months;
    for (const auto& [month, sum] : sums) {
        const double by = is_mean ? sum[2] : 1;
        months.simulated.push_back(sum[0] / by);
        months.measured.push_back(sum[1] / by);
    }
    return months;
}

Months read_by_month(const std::vector<physics::Seconds>& begins,
                     std::span<const double> simulated, const kernel::Readings& readings,
                     const physics::TimeAxis& axis) {
    const auto intervals = study::begins_of(axis, readings.interval);
    std::vector<double> sums(intervals.size(), 0.0), hours(intervals.size(), 0.0);
    std::size_t at = 0;
    for (std::size_t k = 0; k < begins.size(); ++k) {
        while (at + 1 < intervals.size() && intervals[at + 1] <= begins[k]) ++at;
        sums[at] += simulated[k];
        hours[at] += 1;
    }
    const bool is_mean = physics::is_temperature(readings.quantity);
    for (std::size_t k = 0; k < sums.size() && is_mean; ++k) sums[k] /= hours[k];
    return months_of(intervals, sums, readings.values, is_mean);
}

}  // namespace bemcal::loop
