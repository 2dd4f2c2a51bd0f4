/// The days off of a building: public holidays of a country, days that the job lists, and
/// school holidays.
#pragma once

#include "description/building_readers.hpp"

#include <vector>

namespace bemcal::description {

struct DaysOff {
    std::vector<physics::DateRange> holidays;  ///< of schedules that name none themselves
    std::vector<physics::DateRange> school;    ///< study::Case::school_holidays
};

/// \param periods  the country's days are those of their years, a year before and after
DaysOff read_days_off(const Sources& sources, const std::vector<study::Period>& periods);

/// The days of a list of texts; throws UserError at `key`.
std::vector<physics::DateRange> read_dates(const schema::Section& section,
                                           const char* key);

}  // namespace bemcal::description
