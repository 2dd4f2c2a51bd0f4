/// Hours in which something runs, as people say them: one run a day, on three kinds of
/// days.
#pragma once

#include "physics/schedule.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::physics {

/// Whole hours of a day in [from, until); none where both are the same.
struct DailyRun {
    int from = 0, until = 0;

    bool is_off() const { return from == until; }
    bool operator==(const DailyRun&) const = default;
};

/// Hours that one has and the other has not.
int hours_apart(const DailyRun& one, const DailyRun& other);

/// Every run that a day may have: off, and all pairs of whole hours.
std::vector<DailyRun> all_runs();

/// A holiday is a Sunday.
enum class DayKind { working_day, saturday, sunday };
inline constexpr std::size_t n_day_kinds = 3;
const char* name_of(DayKind kind);  ///< "Monday to Friday", "Saturdays", ...

using WeekHours = std::array<DailyRun, n_day_kinds>;

/// The usual hours of a use: "office", "home", "school", "shop"; nothing of another.
std::optional<WeekHours> usual_hours(std::string_view use);

/// Writes 1 in these hours and 0 in all others; periods and a register leave.
void set_hours(const WeekHours& hours, Schedule& schedule);

/// The hours of a schedule that is one number in one run of whole hours a day and one
/// lower number else, Monday to Friday alike, without periods or a register; nothing of
/// another.
std::optional<WeekHours> hours_of(const Schedule& schedule);

/// Each hour of the week as a number, in place of a schedule's: 24 x kind of day + hour.
Schedule numbered_hours(const Schedule& schedule);

/// Whether the hour of that number is one of these.
bool runs_at(const WeekHours& hours, int numbered_hour);

/// "8 to 19 h", "off", "all day".
std::string sentence_of(const DailyRun& run);
/// "Monday to Friday 8 to 19 h, Saturdays off, Sundays and holidays off".
std::string sentence_of(const WeekHours& hours);

}  // namespace bemcal::physics
