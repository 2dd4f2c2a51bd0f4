/// Puts readings on the intervals of a meter: finer ones are summed (temperatures
/// averaged), each at the first hour of its interval.
/// Follows from the calendar. Months, years and bills are read by `bills`.
/// Coarse readings are not split. An interval that is cut or has a gap is missing.
#include "input/intervals.hpp"

#include "base/nan.hpp"
#include "physics/calendar.hpp"

#include <cmath>

namespace bemcal::input {

namespace {

using physics::Interval;
using physics::Seconds;
using std::chrono::seconds;

/// An hourly axis from the interval with `first` to the end of that with `last`, all
/// missing.
RegularSeries empty_hours(Seconds first, Seconds last, Interval interval) {
    const Seconds start = interval_begin(first, interval);
    const Seconds end = next_interval(interval_begin(last, interval), interval);
    RegularSeries hours;
    hours.axis = {start, 3600, static_cast<int>((end - start).count() / 3600)};
    hours.values.assign(static_cast<std::size_t>(hours.axis.n_steps), nan);
    return hours;
}

double& value_at(RegularSeries& series, Seconds time) {
    return series.values[static_cast<std::size_t>(series.axis.step_of(time))];
}

}  // namespace

Interval interval_of_rows(int step_s) {
    if (step_s < 3600) return Interval::step;
    if (step_s == 3600) return Interval::hourly;
    if (step_s <= physics::day_s) return Interval::daily;
    return step_s <= 31 * physics::day_s ? Interval::monthly : Interval::annual;
}

Seconds interval_begin(Seconds time, Interval interval) {
    using namespace std::chrono;
    if (interval == Interval::hourly) return floor<hours>(time);
    const auto date = floor<days>(time);
    if (interval == Interval::daily) return date;
    const year_month_day ymd(date);
    if (interval == Interval::monthly) return sys_days(ymd.year() / ymd.month() / 1);
    return sys_days(ymd.year() / January / 1);
}

Seconds next_interval(Seconds begin, Interval interval) {
    constexpr int longest_s[] = {0, 3600, physics::day_s, 31 * physics::day_s,
                                 366 * physics::day_s};
    return interval_begin(begin + seconds(longest_s[static_cast<int>(interval)]),
                          interval);
}

RegularSeries sum_intervals(const RegularSeries& fine, Interval interval, bool mean) {
    RegularSeries hours =
        empty_hours(fine.axis.start, fine.axis.end() - seconds(1), interval);
    for (int k = 0; k < fine.axis.n_steps;) {
        const Seconds begin = interval_begin(fine.axis.begin_of(k), interval);
        const Seconds end = next_interval(begin, interval);
        const int first = k;
        double sum = 0;
        for (; k < fine.axis.n_steps && fine.axis.begin_of(k) < end; ++k)
            sum += fine.values[static_cast<std::size_t>(k)];
        const bool whole =
            fine.axis.begin_of(first) == begin && fine.axis.begin_of(k) == end;
        if (whole) value_at(hours, begin) = mean ? sum / (k - first) : sum;
    }
    return hours;
}

std::vector<Seconds> bounds_of(const physics::TimeAxis& hours, Interval interval) {
    std::vector<Seconds> bounds;
    for (Seconds time = hours.start; time < hours.end();
         time = next_interval(time, interval))
        bounds.push_back(time);
    bounds.push_back(hours.end());
    return bounds;
}

}  // namespace bemcal::input
