/// Which country's public holidays a building keeps: the calendar whose days look like
/// Sundays. Its days of other years follow by rule.
#pragma once

#include "effects/effect.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::loop {

/// How much each day looks like a Sunday: 0 = not at all, 1 = as one.
struct DayShares {
    std::map<int, double> shares;  ///< by day since 1970, of those that would show it
    double middle = 0;             ///< of ordinary days
    double spread = 0;             ///< a standard deviation of ordinary days
};

struct KeptCalendar {
    std::string place;                ///< "US", or "DE-BY"
    std::vector<effects::Days> days;  ///< of all years, those on weekends too
    bool holds(int day) const;
};

/// The calendar whose days are the most likely to have been closed, without those
/// holidays of it that were not; none: no calendar is likelier than open days.
/// \param days  working days only
/// \param first_year, last_year  of the days that are returned
std::optional<KeptCalendar> kept_calendar(const DayShares& days, int first_year,
                                          int last_year);

}  // namespace bemcal::loop
