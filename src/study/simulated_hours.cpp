/// Cuts hours of all periods to one, and reads them by the intervals of a meter.
/// Plain bookkeeping without a source.
/// An interval that the period cuts has the hours that lie in it.
#include "study/simulated_hours.hpp"

namespace bemcal::study {
namespace {

std::size_t n_hours(const Period& period) {
    return static_cast<std::size_t>(hours_of(period));
}

}  // namespace

std::size_t hours_of_periods(const Case& building) {
    std::size_t n = 0;
    for (const Period& period : building.periods) n += n_hours(period);
    return n;
}

std::vector<double> hours_in(const Case& building, const Period& period,
                             const std::vector<double>& all) {
    std::size_t first = 0;
    for (const Period& each : building.periods) {
        if (each.name == period.name) break;
        first += n_hours(each);
    }
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(n_hours(period))};
}

std::vector<double> over_intervals(const std::vector<physics::Seconds>& begins,
                                   std::span<const double> hours,
                                   const std::vector<physics::Seconds>& intervals,
                                   bool is_mean) {
    std::vector<double> sums(intervals.size(), 0.0), n(intervals.size(), 0.0);
    std::size_t at = 0;
    for (std::size_t k = 0; k < begins.size(); ++k) {
        while (at + 1 < intervals.size() && intervals[at + 1] <= begins[k]) ++at;
        sums[at] += hours[k];
        n[at] += 1;
    }
    for (std::size_t k = 0; k < sums.size() && is_mean; ++k) sums[k] /= n[k];
    return sums;
}

std::vector<double> readings_of_hours(const Case& building, const Period& period,
                                      const kernel::Channel& meter,
                                      const std::vector<double>& all) {
    const physics::TimeAxis axis = axis_of(building, period);
    return over_intervals(
        begins_of(axis, physics::Interval::hourly), hours_in(building, period, all),
        begins_of(axis, meter.interval), physics::is_temperature(meter.quantity));
}

}  // namespace bemcal::study
