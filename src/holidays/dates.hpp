/// The days of a rule in a year: weekdays of a month, Easter, equinoxes, lists.
#pragma once

#include "holidays/rule.hpp"

#include <chrono>
#include <vector>

namespace bemcal::holidays {

using std::chrono::sys_days;

/// \param month, day  from 1
sys_days date_of(int year, int month, int day);

/// From Monday on.
Weekday weekday_of(sys_days day);

int year_of(sys_days day);

/// Easter Sunday of the Gregorian calendar, any year from 1583 on.
sys_days easter_sunday(int year);
/// Easter Sunday of the Julian calendar, as a date of the Gregorian one, 1900 to 2099.
sys_days orthodox_easter_sunday(int year);

/// The days of the rule in that year, most often one; none where the list or the lunar
/// calendar does not have the year. Not for between_holidays.
std::vector<sys_days> days_of(const Rule& rule, int year);

}  // namespace bemcal::holidays
