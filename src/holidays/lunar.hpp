/// Dates of the Chinese and the Korean lunar calendar, 2000 to 2050.
#pragma once

#include <chrono>
#include <optional>

namespace bemcal::holidays {

/// They differ where a new moon falls between midnight in Seoul and in Beijing.
enum class LunarCalendar { chinese, korean };

inline constexpr int first_lunar_year = 2000, last_lunar_year = 2050;

/// \param month  from 1, not a leap month \param day  from 1
/// \return nothing outside the table
std::optional<std::chrono::sys_days> lunar_date(LunarCalendar calendar, int year,
                                                int month, int day);

}  // namespace bemcal::holidays
