/// The countries with their tables of holidays.
#pragma once

#include "holidays/rule.hpp"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace bemcal::holidays {

/// Years that the rules are held to; earlier ones need other rows.
inline constexpr int first_known_year = 2000, last_known_year = 2050;

struct Country {
    const char* code;  ///< ISO 3166
    const char* name;
    std::span<const Row> rows;
    const char* states = "";       ///< with days of their own: "BW BY ..."
    const char* usual_state = "";  ///< taken where none is said
    int first_year = first_known_year;
    int last_year = last_known_year;  ///< up to which lists of dates go
};

/// Their codes, in alphabetical order.
inline constexpr std::array country_codes = {
    "AT", "AU", "BE", "BG", "CA", "CH", "CN", "CY", "CZ", "DE", "DK", "EE", "ES", "FI",
    "FR", "GB", "GR", "HK", "HR", "HU", "IE", "IN", "IT", "JP", "KR", "LT", "LU", "LV",
    "MT", "NL", "NO", "NZ", "PL", "PT", "RO", "SE", "SG", "SI", "SK", "TW", "US"};

/// In the order of their codes.
const std::vector<Country>& countries();
/// nullptr where there is no such country.
const Country* find_country(std::string_view code);

/// The words of a list of states.
std::vector<std::string_view> words_of(std::string_view list);

// The parts of the list, a file each.
std::span<const Country> western_europe();
std::span<const Country> northern_europe();
std::span<const Country> eastern_europe();
std::span<const Country> southern_europe();
std::span<const Country> british_isles();
std::span<const Country> north_america();
std::span<const Country> oceania();
std::span<const Country> east_asia();
std::span<const Country> south_asia();

}  // namespace bemcal::holidays
