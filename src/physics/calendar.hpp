/// Time: evenly spaced steps in local standard time, and what a step is called in a
/// calendar.
///
/// One convention inside: step k covers [start + k step_s, start + (k + 1) step_s), and a
/// value stands for the mean of its step. Readers convert other labels to this. No summer
/// time: a schedule that follows the wall clock says so (`Schedule::summer_time`).
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace bemcal::physics {

using Seconds =
    std::chrono::sys_seconds;  ///< local standard time; the offset is the site's

inline constexpr int day_s = 86400;  ///< seconds of a day

struct TimeAxis {
    Seconds start{};    ///< begin of the first step
    int step_s = 3600;  ///< length of a step [s]; divides 3600
    int n_steps = 0;

    Seconds begin_of(int step) const {
        return start + std::chrono::seconds(static_cast<long long>(step) * step_s);
    }
    Seconds end() const { return begin_of(n_steps); }
    /// The step that contains `time`; negative or >= n_steps where it lies outside (at
    /// most the range of int).
    int step_of(Seconds time) const;
    /// The whole steps between two times, both cut to the axis; the same step length.
    TimeAxis between(Seconds from, Seconds to) const;
};

struct CalendarStep {
    int year, month, day;  ///< month and day from 1
    int hour;              ///< 0..23, the hour in which the step begins
    int weekday;           ///< 0 = Monday .. 6 = Sunday
    int day_of_year;       ///< 1..366
};
CalendarStep calendar_step(Seconds begin_of_step);

/// Months since year 0.
int month_at(Seconds time);

/// \param month  from 1
const char* name_of_month(int month);

/// "2021-03-05" or "2021-03-05 14:30[:00]" (T allowed between; 24:00 is the day's end);
/// throws std::invalid_argument with a sentence that says what was expected.
Seconds parse_time(const std::string& text);
std::string format_time(Seconds time);  ///< "2021-03-05 14:00:00"
std::string format_date(Seconds time);  ///< "2021-03-05"

/// Days that count as another kind of day: public holidays, closures. Yearly ones have
/// year 0.
struct DateRange {
    int first_year = 0, first_month = 1, first_day = 1;
    int last_year = 0, last_month = 1, last_day = 1;
    bool contains(
        const CalendarStep& step) const;  ///< a yearly range may wrap the new year
};
/// "2021-12-24", "2021-12-24/2022-01-02", "12-24/01-02" (every year); both days count.
/// Throws std::invalid_argument with a sentence.
DateRange parse_date_range(const std::string& text);

/// Whether summer time is in force at a local STANDARD time, by rule "eu" (as since
/// 1996), "us" (as since 2007) or "none". Throws std::invalid_argument for another rule.
bool is_summer_time(Seconds local_standard, const std::string& rule, double utc_offset_h);

}  // namespace bemcal::physics
