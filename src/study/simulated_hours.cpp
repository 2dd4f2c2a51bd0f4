/// Cuts hours of all periods to one, and reads them by the intervals of a meter.
/// Plain bookkeeping without a source.
/// An interval that the period cuts has the hours that lie in it.
#include "study/simulated_hours.hpp"

#include "base/nan.hpp"

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

std::vector<Period> periods_asked(const std::vector<Period>& periods,
                                  const AskedPeriods& asked) {
    std::vector<Period> made;
    for (std::size_t p = 0; p < periods.size(); ++p)
        if (asked[p] != 0) made.push_back(periods[p]);
    return made;
}

double hours_asked(const std::vector<Period>& periods, const AskedPeriods& asked) {
    double n = 0;
    for (const Period& period : periods_asked(periods, asked)) n += hours_of(period);
    return n;
}

std::vector<double> cut_to_asked(const std::vector<Period>& periods,
                                 const AskedPeriods& asked,
                                 const std::vector<double>& all) {
    std::vector<double> hours;
    auto from = all.begin();
    for (std::size_t p = 0; p < periods.size(); ++p) {
        const auto to = from + static_cast<std::ptrdiff_t>(n_hours(periods[p]));
        if (asked[p] != 0) hours.insert(hours.end(), from, to);
        from = to;
    }
    return hours;
}

std::vector<double> spread_asked(const std::vector<Period>& periods,
                                 const AskedPeriods& asked,
                                 const std::vector<double>& hours) {
    std::vector<double> all;
    auto from = hours.begin();
    for (std::size_t p = 0; p < periods.size(); ++p) {
        if (asked[p] == 0) {
            all.resize(all.size() + n_hours(periods[p]), nan);
            continue;
        }
        const auto to = from + static_cast<std::ptrdiff_t>(n_hours(periods[p]));
        all.insert(all.end(), from, to);
        from = to;
    }
    return all;
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
