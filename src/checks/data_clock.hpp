/// Clocks, read from the shape of days: whether a series' days move by an hour where
/// summer time begins and ends, how far one series' days lie behind another's, and how
/// far measured sunshine lies behind the sun.
///
/// Days are compared by the cross-correlation of the edges of mean weekday profiles, with
/// a parabola through its three highest points. Leaves out what moves slowly: a schedule
/// that follows the season.
#pragma once

#include "checks/data_readings.hpp"

namespace bemcal::checks {

/// Mean of Monday to Friday by step of the day, of steps [from, to); empty with fewer
/// than 8 readings of a step or where days are flat (sd below 5 % of the mean).
std::vector<double> weekday_profile(const DataSeries& series, int from, int to);

struct Lag {
    double hours = 0;        ///< of the second behind the first
    double correlation = 0;  ///< at that lag
    double unmoved = 0;      ///< correlation without a lag
};
/// Of two profiles of a day with the same number of steps.
Lag lag_of(const std::vector<double>& first, const std::vector<double>& second);

struct ClockChange {
    int at = 0;  ///< first step after it
    bool to_summer = true;
};

enum class SummerTime { unknown, stands, moves, mixed };

struct SummerShift {
    SummerTime verdict = SummerTime::unknown;
    struct Judged {
        ClockChange change;
        double hours;  ///< lag of summer behind winter; -1 = follows the wall clock
    };
    std::vector<Judged> changes;  ///< those with clear days on both sides
    double hours = 0;             ///< mean lag
    double natural = 0;  ///< mean size of such a lag four and six weeks from the changes
};
/// Three weeks on either side of each change, whose edges of the day correlate by 0.75.
/// A verdict needs natural lags of at most 0.25 h, and other than `stands` a change each
/// way. `moves` and `stands`: each lag within 0.4 h of -1 or of 0, the mean within 0.25
/// h; `mixed`: some within 0.25 h of the one, the others of the other.
SummerShift summer_shift(const DataSeries& series,
                         const std::vector<ClockChange>& changes);

struct NoonOffset {
    int n_days = 0;
    double hours = 0;  ///< of measured sunshine behind the sun
};
/// Median distance of the two centres of mass on the clearest tenth of days.
/// \param sun  what a horizontal plane would get without an atmosphere [size of measured]
NoonOffset noon_offset(const DataSeries& measured, std::span<const double> sun);

}  // namespace bemcal::checks
