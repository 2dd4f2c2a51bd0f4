/// Groups readings by calendar day or month, and adds them up (means of a temperature).
/// Those count that have readings of at least 90 % of their hours.
/// Follows from the calendar and the readings' own interval; predictions are added up
/// over the same readings.
/// Nothing is filled: a total is that of the readings there are.
#include "study/complete_intervals.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bemcal::study {
namespace {

using physics::Interval;
using physics::Seconds;
using std::chrono::days;

std::chrono::year_month month_of(Seconds time) {
    const std::chrono::year_month_day date(std::chrono::floor<days>(time));
    return date.year() / date.month();
}

Seconds begin_of(Seconds time, Interval by) {
    if (by == Interval::daily) return std::chrono::floor<days>(time);
    return std::chrono::sys_days(month_of(time) / 1);
}

/// Of the day or month, or what a reading of that interval spans.
double hours_of(Seconds begin, Interval by) {
    if (by == Interval::daily) return 24;
    const auto month = month_of(begin);
    const unsigned n_days = static_cast<unsigned>((month / std::chrono::last).day());
    return 24.0 * n_days;
}

/// The shortest time from one reading to the next; an hour for a single one.
double hours_of_step(std::span<const Seconds> begins) {
    auto shortest = std::chrono::seconds(std::chrono::hours(begins.size() < 2 ? 1 : 24));
    for (std::size_t k = 1; k < begins.size(); ++k)
        shortest = std::min(shortest, begins[k] - begins[k - 1]);
    return static_cast<double>(shortest.count()) / 3600;
}

/// Bills between reads of their own are whole as they are.
std::vector<CompleteInterval> each_its_own(std::span<const Seconds> begins,
                                           std::span<const double> measured) {
    std::vector<CompleteInterval> intervals;
    for (std::size_t k = 0; k < begins.size(); ++k)
        if (!std::isnan(measured[k])) intervals.push_back({begins[k], {k}});
    return intervals;
}

}  // namespace

std::vector<CompleteInterval> complete_intervals(std::span<const Seconds> begins,
                                                 std::span<const double> measured,
                                                 const physics::Intervals& own,
                                                 Interval by) {
    if (own > by) return {};
    if (own.are_own() && own == by) return each_its_own(begins, measured);
    const double step = hours_of_step(begins);
    std::vector<CompleteInterval> intervals;
    for (std::size_t k = 0; k < begins.size(); ++k) {
        if (std::isnan(measured[k])) continue;
        const Seconds begin = begin_of(begins[k], by);
        if (intervals.empty() || intervals.back().begin != begin)
            intervals.push_back({begin, {}});
        intervals.back().readings.push_back(k);
    }
    std::erase_if(intervals, [&](const CompleteInterval& interval) {
        const double each = own >= Interval::daily ? hours_of(interval.begin, own) : step;
        return static_cast<double>(interval.readings.size()) * each <
               complete_share * hours_of(interval.begin, by);
    });
    return intervals;
}

std::vector<double> totals_of(const std::vector<CompleteInterval>& intervals,
                              std::span<const double> values,
                              physics::Quantity quantity) {
    std::vector<double> totals;
    totals.reserve(intervals.size());
    for (const CompleteInterval& interval : intervals) {
        double sum = 0;
        for (const std::size_t k : interval.readings) sum += values[k];
        const bool is_mean = physics::is_temperature(quantity);
        totals.push_back(is_mean ? sum / static_cast<double>(interval.readings.size())
                                 : sum);
    }
    return totals;
}

Matrix totals_of(const std::vector<CompleteInterval>& intervals, const Matrix& draws,
                 physics::Quantity quantity) {
    Matrix totals(draws.rows, intervals.size());
    for (std::size_t d = 0; d < draws.rows; ++d)
        std::ranges::copy(totals_of(intervals, draws.row(d), quantity),
                          totals.row(d).begin());
    return totals;
}

}  // namespace bemcal::study
