/// Public holidays of Canada's provinces, the United States and their states.
/// Source: the laws of the countries, provinces and states, by python-holidays 0.10.1
/// (MIT), with later federal changes. Canada without a province is Ontario. Left out:
/// what states have changed since 2020, Canada's federal days off where a province does
/// not have them.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

// clang-format off: a row a line
constexpr Row canada[] = {
    {"New Year's Day", on(1, 1), always, weekend_to_free},
    {"Family Day", nth(3, monday, 2), always, none, "AB"},
    {"Family Day", nth(3, monday, 2), since(2007), none, "SK"},
    {"Family Day", nth(3, monday, 2), since(2008), none, "ON"},
    {"Family Day", nth(3, monday, 2), since(2018), none, "NB"},
    {"Family Day", nth(2, monday, 2), {2013, 2018}, none, "BC"},
    {"Family Day", nth(3, monday, 2), since(2019), none, "BC"},
    {"Louis Riel Day", nth(3, monday, 2), since(2008), none, "MB"},
    {"Islander Day", nth(2, monday, 2), only(2009), none, "PE"},
    {"Islander Day", nth(3, monday, 2), since(2010), none, "PE"},
    {"Heritage Day", nth(3, monday, 2), since(2015), none, "NS"},
    {"Heritage Day", up_to(sunday, 3, 1).plus(-2), always, none, "YT"},
    {"St. Patrick's Day", nearest(monday, 3, 17), always, none, "NL"},
    {"Good Friday", easter(-2), always, none, "!QC"},
    {"Easter Monday", easter(1), always, none, "QC"},
    {"St. George's Day", nearest(monday, 4, 23), until(2009), none, "NL"},
    {"St. George's Day", on(4, 19), only(2010), none, "NL"},
    {"St. George's Day", nearest(monday, 4, 23), since(2011), none, "NL"},
    {"Victoria Day", up_to(monday, 5, 24), always, none, "!NB NL NS PE QC"},
    {"National Patriots' Day", up_to(monday, 5, 24), always, none, "QC"},
    {"National Aboriginal Day", on(6, 21), always, none, "NT"},
    {"National Aboriginal Day", on(6, 21), since(2017), none, "YT"},
    {"St. Jean Baptiste Day", on(6, 24), always, sunday_to_monday, "QC"},
    {"Discovery Day", nearest(monday, 6, 24), always, none, "NL"},
    {"Canada Day", on(7, 1), always, weekend_to_monday, "!NL"},
    {"Memorial Day", on(7, 1), always, weekend_to_monday, "NL"},
    {"Nunavut Day", on(4, 1), only(2000), none, "NU"},
    {"Nunavut Day", on(7, 9), since(2001), sunday_to_monday, "NU"},
    {"Civic Holiday", nth(1, monday, 8), always, none, "AB BC MB NB NT ON SK"},
    {"Discovery Day", nth(3, monday, 8), always, none, "YT"},
    {"Labour Day", nth(1, monday, 9)},
    {"Truth and Reconciliation", on(9, 30), since(2022), none, "NT NU PE"},
    {"Truth and Reconciliation", on(9, 30), since(2023), none, "BC YT"},
    {"Truth and Reconciliation", on(9, 30), since(2024), none, "MB"},
    {"Thanksgiving", nth(2, monday, 10), always, none, "!NB NL NS PE"},
    {"Remembrance Day", on(11, 11), always, none, "AB BC MB NB NU YT"},
    {"Remembrance Day", on(11, 11), always, sunday_to_monday, "NL NS NT PE SK"},
    {"Christmas Day", on(12, 25), always, weekend_to_free},
    {"Boxing Day", on(12, 26), always, weekend_to_free},
};

/// Four years from 1789 on, so from 2001.
constexpr Years inaugurations{.first = 2001, .every = 4, .rest = 1};
constexpr Years even_since(int year) {
    return {.first = year, .every = 2, .rest = 0};
}
constexpr Years odd_since(int year) {
    return {.first = year, .every = 2, .rest = 1};
}

constexpr Substitute wednesday_moves_by_two{.shift = {0, 0, 2, 0, 0, 0, 0},
                                            .moves = true};
constexpr Substitute to_thursday{.shift = {0, 0, 0, 0, -1, -1, -2}};
constexpr Substitute to_tuesday{.shift = {1, 0, 0, 0, 0, 2, 1}};
constexpr Substitute saturday_to_friday{.shift = {0, 0, 0, 0, 0, -1, 0}};

constexpr Row united_states[] = {
    {"New Year's Day", on(1, 1), always, to_nearest_weekday},
    {"Epiphany", on(1, 6), always, none, "PR VI"},
    {"Lee Jackson Day", nth(3, monday, 1).plus(-3), until(2020), none, "VA"},
    {"Confederate Memorial Day", on(1, 19), always, none, "TX"},
    {"Inauguration Day", on(1, 20), inaugurations, sunday_to_monday, "DC LA MD VA"},
    {"Martin Luther King Day", nth(3, monday, 1)},
    {"Lincoln's Birthday", on(2, 12), always, to_nearest_weekday, "CT IA IL NJ NY"},
    {"Lincoln's Birthday", on(2, 12), until(2009), to_nearest_weekday, "CA"},
    {"Susan B. Anthony Day", on(2, 15), since(2014), none, "CA"},
    {"Susan B. Anthony Day", on(2, 15), since(2011), none, "FL"},
    {"Susan B. Anthony Day", on(2, 15), since(2004), none, "NY"},
    {"Susan B. Anthony Day", on(2, 15), always, none, "WI"},
    {"Washington's Birthday", nth(3, monday, 2), always, none, "!DE FL GA NM"},
    {"Mardi Gras", easter(-47), always, none, "LA"},
    {"Guam Discovery Day", nth(1, monday, 3), always, none, "GU"},
    {"Casimir Pulaski Day", nth(1, monday, 3), always, none, "IL"},
    {"Texas Independence Day", on(3, 2), always, none, "TX"},
    {"Town Meeting Day", nth(1, tuesday, 3), always, none, "VT"},
    {"Evacuation Day", on(3, 17), always, weekend_to_monday, "MA"},
    {"Emancipation Day", on(3, 22), always, sunday_to_monday, "PR"},
    {"Prince Kuhio Day", on(3, 26), always, to_nearest_weekday, "HI"},
    {"Seward's Day", last(monday, 3), always, none, "AK"},
    {"Cesar Chavez Day", on(3, 31), always, sunday_to_monday, "CA"},
    {"Cesar Chavez Day", on(3, 31), always, none, "TX"},
    {"Transfer Day", on(3, 31), always, none, "VI"},
    {"Emancipation Day", on(4, 16), since(2005), to_nearest_weekday, "DC"},
    {"Patriots' Day", nth(3, monday, 4), always, none, "MA ME"},
    {"Holy Thursday", easter(-3), always, none, "VI"},
    {"Good Friday", easter(-2), always, none, "CT DE GU IN KY LA NC NJ PR TN TX VI"},
    {"Easter Monday", easter(1), always, none, "VI"},
    {"Confederate Memorial Day", nth(4, monday, 4), always, none, "AL GA MS SC"},
    {"San Jacinto Day", on(4, 21), always, none, "TX"},
    {"Arbor Day", last(friday, 4), always, none, "NE"},
    {"Primary Election Day", nth(1, monday, 5).plus(1), even_since(2006), none, "IN"},
    {"Primary Election Day", nth(1, monday, 5).plus(1), odd_since(2015), none, "IN"},
    {"Truman Day", on(5, 8), always, to_nearest_weekday, "MO"},
    {"Memorial Day", last(monday, 5)},
    {"Jefferson Davis Birthday", nth(1, monday, 6), always, none, "AL"},
    {"Kamehameha Day", on(6, 11), until(2010), none, "HI"},
    {"Kamehameha Day", on(6, 11), since(2011), to_nearest_weekday, "HI"},
    {"Emancipation Day", on(6, 19), until(2020), none, "TX"},
    {"Juneteenth", on(6, 19), since(2021), to_nearest_weekday},
    {"West Virginia Day", on(6, 20), always, to_nearest_weekday, "WV"},
    {"Emancipation Day", on(7, 3), always, none, "VI"},
    {"Independence Day", on(7, 4), always, to_nearest_weekday},
    {"Liberation Day", on(7, 21), always, none, "GU"},
    {"Pioneer Day", on(7, 24), always, to_nearest_weekday, "UT"},
    {"Constitution Day", on(7, 25), always, sunday_to_monday, "PR"},
    {"Victory Day", nth(2, monday, 8), always, none, "RI"},
    {"Statehood Day", nth(3, friday, 8), always, none, "HI"},
    {"Bennington Battle Day", on(8, 16), always, to_nearest_weekday, "VT"},
    {"Lyndon Baines Johnson Day", on(8, 27), always, none, "TX"},
    {"Labor Day", nth(1, monday, 9)},
    {"Columbus Day", nth(2, monday, 10), always, none, "!AK AR CA DE FL HI NV TX"},
    {"Columbus Day", nth(2, monday, 10), until(2008), none, "CA"},
    {"Alaska Day", on(10, 18), always, to_nearest_weekday, "AK"},
    {"Nevada Day", last(friday, 10), always, none, "NV"},
    {"Liberty Day", on(11, 1), always, none, "VI"},
    {"Election Day", nth(1, monday, 11).plus(1), even_since(2008), none,
     "DE HI IL IN LA MT NH NJ NY WV"},
    {"Election Day", nth(1, monday, 11).plus(1), odd_since(2015), none, "IN NY"},
    {"Election Day", nth(1, monday, 11).plus(1), since(2020), none, "VA"},
    {"All Souls' Day", on(11, 2), always, none, "GU"},
    {"Veterans Day", on(11, 11), always, to_nearest_weekday},
    {"Discovery Day", on(11, 19), always, sunday_to_monday, "PR"},
    {"Thanksgiving", nth(4, thursday, 11)},
    {"Day after Thanksgiving", nth(4, thursday, 11).plus(1), always, none,
     "CA DE FL NC NH NM NV OK TX VA WV"},
    {"Day after Thanksgiving", nth(4, thursday, 11).plus(1), since(2008), none, "MD"},
    {"Day after Thanksgiving", nth(4, thursday, 11).plus(1), since(2010), none, "IN"},
    {"State Holiday", up_to(friday, 11, 29), always, none, "GA"},
    {"Lady of Camarin Day", on(12, 8), always, none, "GU"},
    {"Christmas Eve", on(12, 24), always, to_thursday, "AS TX"},
    {"Christmas Eve", on(12, 24), since(2012), to_thursday, "WI"},
    {"Christmas Eve", on(12, 24), since(2013), to_thursday, "KS MI NC"},
    {"Washington's Birthday", on(12, 24), always, wednesday_moves_by_two, "GA"},
    {"Christmas Day", on(12, 25), always, to_nearest_weekday},
    {"Day after Christmas", on(12, 26), since(2013), to_tuesday, "NC"},
    {"Day after Christmas", on(12, 26), always, none, "TX VI"},
    {"New Year's Eve", on(12, 31), since(2012), saturday_to_friday, "WI"},
    {"New Year's Eve", on(12, 31), since(2013), saturday_to_friday, "KY MI"},
};
// clang-format on

constexpr Country countries_of_north_america[] = {
    {.code = "CA",
     .name = "Canada",
     .rows = canada,
     .states = "AB BC MB NB NL NS NT NU ON PE QC SK YT",
     .usual_state = "ON"},
    {"US", "United States", united_states,
     "AK AL AR AS AZ CA CO CT DC DE FL FM GA GU HI IA ID IL IN KS KY LA MA MD ME MH MI "
     "MN MO MP MS MT NC ND NE NH NJ NM NV NY OH OK OR PA PR PW RI SC SD TN TX UT VA VI "
     "VT WA WI WV WY"},
};

}  // namespace

std::span<const Country> north_america() {
    return countries_of_north_america;
}

}  // namespace bemcal::holidays
