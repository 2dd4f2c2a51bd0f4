/// Adds hours up by year and month.
/// Plain bookkeeping without a source. A month without a reading is left out.
#include "loop/months.hpp"

#include "study/simulated_hours.hpp"

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
    const bool is_mean = physics::is_temperature(readings.quantity);
    return months_of(intervals,
                     study::over_intervals(begins, simulated, intervals, is_mean),
                     readings.values, is_mean);
}

}  // namespace bemcal::loop
