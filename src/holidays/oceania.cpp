/// Public holidays of Australia's states and New Zealand's regions.
/// Source: the states' holidays acts and New Zealand's Holidays Act 2003 and Te Kahui o
/// Matariki Public Holiday Act 2022, by python-holidays 0.10.1 (MIT).
/// Left out: half days, days of towns but Melbourne's and Brisbane's, what single states
/// have changed for a year.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

constexpr int family_days[] = {20071106, 20081104, 20091103, 20100926, 20111010, 20121008,
                               20130930, 20140929, 20150928, 20160926, 20170925};
/// The Friday before the football final, as gazetted; 2026 and after as usual.
constexpr int final_days[] = {20151002, 20160930, 20170929, 20180928, 20190927, 20201023,
                              20210924, 20220923, 20230929, 20240927, 20250926};

/// Proclaimed for other days than the Monday up to 1 October.
constexpr int western_birthdays[] = {20111028, 20180924, 20240923};
constexpr int moved_shows[] = {20200814, 20211029};

// clang-format off: a row a line
constexpr Row australia[] = {
    {"New Year's Day", on(1, 1), always, weekend_to_monday},
    {"Australia Day", on(1, 26), always, weekend_to_monday},
    {"Adelaide Cup", nth(3, monday, 3), until(2005), none, "SA"},
    {"Adelaide Cup", nth(2, monday, 3), since(2006), none, "SA"},
    {"Canberra Day", nth(3, monday, 3), until(2007), none, "ACT"},
    {"Canberra Day", nth(2, monday, 3), since(2008), none, "ACT"},
    {"Labour Day", nth(1, monday, 3), always, none, "WA"},
    {"Labour Day", nth(2, monday, 3), always, none, "TAS VIC"},
    {"Good Friday", easter(-2)},
    {"Easter Saturday", easter(-1), always, none, "ACT NSW NT QLD SA VIC"},
    {"Easter Sunday", easter(0), always, none, "ACT NSW QLD VIC"},
    {"Easter Monday", easter(1)},
    {"Anzac Day", on(4, 25), always, none, "!ACT NT QLD SA WA"},
    {"Anzac Day", on(4, 25), always, sunday_to_monday, "ACT NT QLD SA"},
    {"Anzac Day", on(4, 25), always, weekend_to_monday, "WA"},
    {"Day after Anzac Day", on(4, 27), only(2020), none, "ACT"},
    {"Day after Anzac Day", on(4, 27), only(2026), none, "ACT NSW"},
    {"Day after Anzac Day", on(4, 26), only(2027), none, "NSW"},
    {"Easter and Anzac Day", on(4, 26), only(2011)},
    {"Labour Day", nth(1, monday, 5), until(2012), none, "QLD"},
    {"Labour Day", nth(1, monday, 5), since(2016), none, "QLD"},
    {"May Day", nth(1, monday, 5), always, none, "NT"},
    {"Reconciliation Day", from(monday, 5, 27), since(2018), none, "ACT"},
    {"Western Australia Day", nth(1, monday, 6), always, none, "WA"},
    {"Sovereign's Birthday", nth(2, monday, 6), always, none, "ACT NSW NT SA TAS VIC"},
    {"Sovereign's Birthday", nth(2, monday, 6), until(2015), none, "QLD"},
    {"Sovereign's Birthday", nth(1, monday, 10), only(2012), none, "QLD"},
    {"Sovereign's Birthday", nth(1, monday, 10), since(2016), none, "QLD"},
    {"Sovereign's Birthday", up_to(monday, 10, 1), until(2010), none, "WA"},
    {"Sovereign's Birthday", up_to(monday, 10, 1), {2012, 2017}, none, "WA"},
    {"Sovereign's Birthday", up_to(monday, 10, 1), {2019, 2023}, none, "WA"},
    {"Sovereign's Birthday", up_to(monday, 10, 1), since(2025), none, "WA"},
    {"Sovereign's Birthday", listed(western_birthdays), always, none, "WA"},
    {"Picnic Day", nth(1, monday, 8), always, none, "NT"},
    {"Bank Holiday", nth(1, monday, 8), always, none, "NSW"},
    {"Royal Queensland Show", from(friday, 8, 5).plus(5), until(2019), none, "QLD"},
    {"Royal Queensland Show", listed(moved_shows), always, none, "QLD"},
    {"Royal Queensland Show", from(friday, 8, 5).plus(5), since(2022), none, "QLD"},
    {"National Day of Mourning", on(9, 22), only(2022)},
    {"Family & Community Day", listed(family_days), always, none, "ACT"},
    {"Friday before the Final", listed(final_days), until(2025), none, "VIC"},
    {"Friday before the Final", from(friday, 9, 24), since(2026), none, "VIC"},
    {"Labour Day", nth(1, monday, 10), always, none, "ACT NSW SA"},
    {"Labour Day", nth(1, monday, 10), {2013, 2015}, none, "QLD"},
    {"Melbourne Cup", nth(1, tuesday, 11), always, none, "VIC"},
    {"Christmas Day", on(12, 25), always, weekend_to_free},
    {"Boxing Day", on(12, 26), always, weekend_to_free},
};

constexpr int matariki[] = {20220624, 20230714, 20240628, 20250620, 20260710,
                            20270625, 20280714, 20290706, 20300621};

constexpr Row new_zealand[] = {
    {"New Year's Day", on(1, 1), always, weekend_to_free},
    {"Day after New Year's Day", on(1, 2), always, weekend_to_free},
    {"Southland Anniversary", nearest(monday, 1, 17), until(2011), none, "STL"},
    {"Southland Anniversary", easter(2), since(2012), none, "STL"},
    {"Wellington Anniversary", nearest(monday, 1, 22), always, none, "WGN"},
    {"Auckland Anniversary", nearest(monday, 1, 29), always, none, "AUK NTL"},
    {"Nelson Anniversary", nearest(monday, 2, 1), always, none, "NSN"},
    {"Waitangi Day", on(2, 6), until(2013)},
    {"Waitangi Day", on(2, 6), since(2014), weekend_to_monday},
    {"Taranaki Anniversary", nth(2, monday, 3), always, none, "TKI"},
    {"Otago Anniversary", nearest(monday, 3, 23).unless_easter(1, 1), always, none,
     "OTA"},
    {"Good Friday", easter(-2)},
    {"Easter Monday", easter(1)},
    {"Anzac Day", on(4, 25), until(2013)},
    {"Anzac Day", on(4, 25), since(2014), weekend_to_monday},
    {"Sovereign's Birthday", nth(1, monday, 6)},
    {"Matariki", listed(matariki)},
    {"South Canterbury Anniversary", nth(4, monday, 9), always, none, "STC"},
    {"Memorial of Queen Elizabeth II", on(9, 26), only(2022)},
    {"Hawke's Bay Anniversary", nth(4, monday, 10).plus(-3), always, none, "HKB"},
    {"Labour Day", nth(4, monday, 10)},
    {"Marlborough Anniversary", nth(4, monday, 10).plus(7), always, none, "MBH"},
    {"Canterbury Anniversary", nth(1, tuesday, 11).plus(10), always, none, "CAN"},
    {"Chatham Islands Anniversary", nearest(monday, 11, 30), always, none, "CIT"},
    {"Westland Anniversary", nearest(monday, 12, 1), until(2004), none, "WTL"},
    {"Westland Anniversary", on(12, 5), only(2005), none, "WTL"},
    {"Westland Anniversary", nearest(monday, 12, 1), since(2006), none, "WTL"},
    {"Christmas Day", on(12, 25), always, weekend_to_free},
    {"Boxing Day", on(12, 26), always, weekend_to_free},
};
// clang-format on

constexpr Country countries_of_oceania[] = {
    {"AU", "Australia", australia, "ACT NSW NT QLD SA TAS VIC WA"},
    {.code = "NZ",
     .name = "New Zealand",
     .rows = new_zealand,
     .states = "AUK CAN CIT HKB MBH NSN NTL OTA STC STL TKI WGN WTL",
     .last_year = 2030},
};

}  // namespace

std::span<const Country> oceania() {
    return countries_of_oceania;
}

}  // namespace bemcal::holidays
