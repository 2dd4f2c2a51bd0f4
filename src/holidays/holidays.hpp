/// Public holidays of a country, or of one of its states, in a year. There is no library
/// of them for C++; Python's `holidays` is what tests compare with.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace bemcal::holidays {

struct Holiday {
    std::chrono::sys_days date;
    std::string name;
    bool is_substitute = false;  ///< the day off for one that falls on a weekend
};

/// In the order of their dates; two may share one.
/// \param country  ISO 3166 code, as "DE" \param state  as "BY"; "" = the days of the
/// whole country, or of its usual state
/// Throws std::invalid_argument with a sentence for an unknown country or state, or a
/// year that the country's tables do not reach.
std::vector<Holiday> holidays_of(const std::string& country, const std::string& state,
                                 int year);

/// "2021-11-25 Thu  Thanksgiving" for each day of the years, a line each.
/// \param place  "US" or "US-CA" \param years  "2021" or "2020-2022"
/// Throws std::invalid_argument with a sentence.
std::string describe(const std::string& place, const std::string& years);
/// Every country with its code and states.
std::string describe_countries();

}  // namespace bemcal::holidays
