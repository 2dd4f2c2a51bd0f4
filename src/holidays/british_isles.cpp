/// Public holidays of the United Kingdom's nations and of Ireland.
/// Source: the Banking and Financial Dealings Act 1971 and its proclamations, the St
/// Andrew's Day Bank Holiday (Scotland) Act 2007, Ireland's Organisation of Working Time
/// Act 1997.
/// Without a nation the United Kingdom is England. Left out: local days of Scotland.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

// clang-format off: a row a line
constexpr Row united_kingdom[] = {
    {"New Year's Day", on(1, 1), always, weekend_to_free},
    {"2nd January", on(1, 2), always, weekend_to_free, "SCT"},
    {"St Patrick's Day", on(3, 17), always, weekend_to_monday, "NIR"},
    {"Good Friday", easter(-2)},
    {"Easter Monday", easter(1), always, none, "!SCT"},
    {"Royal wedding", on(4, 29), only(2011)},
    {"Early May bank holiday", nth(1, monday, 5), until(2019)},
    {"Early May bank holiday", on(5, 8), only(2020)},
    {"Early May bank holiday", nth(1, monday, 5), since(2021)},
    {"Coronation", on(5, 8), only(2023)},
    {"Golden Jubilee", on(6, 3), only(2002)},
    {"Spring bank holiday", on(6, 4), only(2002)},
    {"Diamond Jubilee", on(6, 5), only(2012)},
    {"Spring bank holiday", on(6, 4), only(2012)},
    {"Platinum Jubilee", on(6, 3), only(2022)},
    {"Spring bank holiday", on(6, 2), only(2022)},
    {"Spring bank holiday", last(monday, 5), until(2001)},
    {"Spring bank holiday", last(monday, 5), {2003, 2011}},
    {"Spring bank holiday", last(monday, 5), {2013, 2021}},
    {"Spring bank holiday", last(monday, 5), since(2023)},
    {"World Cup bank holiday", on(6, 15), only(2026), none, "SCT"},
    {"Battle of the Boyne", on(7, 12), always, weekend_to_monday, "NIR"},
    {"Summer bank holiday", nth(1, monday, 8), always, none, "SCT"},
    {"Summer bank holiday", last(monday, 8), always, none, "!SCT"},
    {"State funeral of Queen Elizabeth II", on(9, 19), only(2022)},
    {"St Andrew's Day", on(11, 30), since(2007), weekend_to_monday, "SCT"},
    {"Christmas Day", on(12, 25), always, weekend_to_free},
    {"Boxing Day", on(12, 26), always, weekend_to_free},
};

/// A Friday stays, any other day gives way to the Monday after it.
constexpr Substitute monday_unless_friday{.shift = {0, 6, 5, 4, 0, 2, 1}, .moves = true};

constexpr Row ireland[] = {
    {"New Year's Day", on(1, 1), always, weekend_to_monday},
    {"St Brigid's Day", on(2, 1), since(2023), monday_unless_friday},
    {"St Patrick's Day", on(3, 17), always, weekend_to_monday},
    {"Remembrance of the pandemic", on(3, 18), only(2022)},
    {"Easter Monday", easter(1)},
    {"May Day", nth(1, monday, 5)},
    {"June holiday", nth(1, monday, 6)},
    {"August holiday", nth(1, monday, 8)},
    {"October holiday", last(monday, 10)},
    {"Christmas Day", on(12, 25), always, weekend_to_free},
    {"St Stephen's Day", on(12, 26), always, weekend_to_free},
};
// clang-format on

constexpr Country countries_of_british_isles[] = {
    {.code = "GB",
     .name = "United Kingdom",
     .rows = united_kingdom,
     .states = "ENG NIR SCT WLS",
     .usual_state = "ENG"},
    {"IE", "Ireland", ireland},
};

}  // namespace

std::span<const Country> british_isles() {
    return countries_of_british_isles;
}

}  // namespace bemcal::holidays
