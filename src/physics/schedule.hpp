/// Schedules: a number for every hour, from day types, calendar periods and holidays.
#pragma once

#include "physics/calendar.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::physics {

using Day = std::array<double, 24>;  ///< value k holds from hour k to k + 1

/// One value for each hour of the week, with calendar periods that replace it.
struct Schedule {
    std::string name;
    std::array<Day, 7> week{};  ///< Monday first
    Day holiday{};              ///< on days in `holidays`, whatever the period
    std::vector<DateRange> holidays;
    struct Period {
        DateRange dates;
        std::array<Day, 7> week{};
    };
    std::vector<Period> periods;  ///< the last that contains the day wins
    /// Of a register, the number of each day (persons): the values are multiplied by it;
    /// days that are not in it count 0.
    std::optional<std::map<std::chrono::sys_days, double>> days;
    /// "none", "eu" or "us": hours follow the wall clock.
    std::string summer_time = "none";
};

/// The schedule's value for every step of the axis: that of the hour in which the step
/// begins. Throws std::invalid_argument for an unknown rule of summer time.
std::vector<double> values_of(const Schedule& schedule, const TimeAxis& axis,
                              double utc_offset_h);

}  // namespace bemcal::physics
