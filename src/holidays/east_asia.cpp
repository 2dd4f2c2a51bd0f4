/// Public holidays of China, Hong Kong, Japan, South Korea and Taiwan.
/// Source: China's Regulation on Public Holidays for National Annual Festivals (2007,
/// 2013, 2024) and the State Council's notices of each year; Hong Kong's General Holidays
/// Ordinance; Japan's Act on National Holidays; Korea's Regulations on Holidays of
/// Government Offices; Taiwan's rules of 2015 and its act of 2025.
/// China's week off is there as it was arranged, after 2026 by the usual pattern;
/// Taiwan's bridges by python-holidays 0.109 (MIT). Left out: the weekends that are
/// worked for them.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

/// As the notices arrange it: a Tuesday with its Monday, a Thursday with its Friday.
constexpr Substitute long_weekend{.shift = {0, -1, 0, 1, 0, 2, 1}};

/// What the notices give beyond the pattern.
constexpr int china_new_year[] = {20120103, 20130102, 20130103};
constexpr int china_spring[] = {20140206, 20200131, 20240217, 20260215};
constexpr int china_qingming[] = {20120402, 20120403};
constexpr int china_labour[] = {
    20130429, 20130430, 20190502, 20190503, 20200504, 20200505, 20210504, 20210505,
    20220503, 20220504, 20230502, 20230503, 20240502, 20240503, 20250505, 20260505};
constexpr int china_dragon_boat[] = {20100614, 20100615, 20120622, 20130610, 20130611};
constexpr int china_autumn[] = {20100923, 20100924};
constexpr int china_eighth[] = {20171008, 20201008, 20251008};
constexpr int china_victory[] = {20150903, 20150904};

// clang-format off: a row a line
constexpr Row china[] = {
    {"New Year's Day", on(1, 1), until(2012), long_weekend},
    {"New Year's Day", on(1, 1), only(2013)},
    {"New Year's Day", on(1, 1), since(2014), long_weekend},
    {"New Year's Day", listed(china_new_year)},
    {"Spring Festival's Eve", chinese(1, 1).plus(-1), until(2013)},
    {"Spring Festival's Eve", chinese(1, 1).plus(-1), {2015, 2023}},
    {"Spring Festival's Eve", chinese(1, 1).plus(-1), since(2025)},
    {"Spring Festival", chinese(1, 1)},
    {"Spring Festival", chinese(1, 2)},
    {"Spring Festival", chinese(1, 3)},
    {"Spring Festival", chinese(1, 4)},
    {"Spring Festival", chinese(1, 5)},
    {"Spring Festival", chinese(1, 6)},
    {"Spring Festival", chinese(1, 7), since(2024)},
    {"Spring Festival", listed(china_spring)},
    {"Qingming", qingming, until(2011), long_weekend},
    {"Qingming", qingming, only(2012)},
    {"Qingming", qingming, since(2013), long_weekend},
    {"Qingming", listed(china_qingming)},
    {"Labour Day", on(5, 1), always, long_weekend},
    {"Labour Day", on(5, 2), since(2025), weekend_to_free},
    {"Labour Day", listed(china_labour)},
    {"Dragon Boat Festival", chinese(5, 5), until(2011), long_weekend},
    {"Dragon Boat Festival", chinese(5, 5), {2012, 2013}},
    {"Dragon Boat Festival", chinese(5, 5), since(2014), long_weekend},
    {"Dragon Boat Festival", listed(china_dragon_boat)},
    {"Victory Day", listed(china_victory)},
    {"Mid-Autumn Festival", chinese(8, 15), until(2011), long_weekend},
    {"Mid-Autumn Festival", chinese(8, 15), only(2012)},
    {"Mid-Autumn Festival", chinese(8, 15), {2013, 2014}, long_weekend},
    {"Mid-Autumn Festival", chinese(8, 15), {2015, 2017}},
    {"Mid-Autumn Festival", chinese(8, 15).plus(1), only(2016)},
    {"Mid-Autumn Festival", chinese(8, 15), since(2018), long_weekend},
    {"Mid-Autumn Festival", listed(china_autumn)},
    {"National Day", on(10, 1)},
    {"National Day", on(10, 2)},
    {"National Day", on(10, 3)},
    {"National Day", on(10, 4)},
    {"National Day", on(10, 5)},
    {"National Day", on(10, 6)},
    {"National Day", on(10, 7), until(2022)},
    {"National Day", on(10, 7), since(2024)},
    {"National Day", listed(china_eighth)},
};

/// A Sunday, or a day with another holiday, gives way to the next free day.
constexpr Substitute day_following{
    .shift = {0, 0, 0, 0, 0, 0, 1}, .moves = true, .to_free = true, .when_taken = true};
constexpr Substitute day_preceding{.shift = {0, 0, 0, 0, 0, 0, -1}};
constexpr Substitute moved_to_day_preceding{.shift = {0, 0, 0, 0, 0, 0, -1},
                                            .moves = true};

constexpr Row hong_kong[] = {
    {"New Year's Day", on(1, 1), always, day_following},
    {"Lunar New Year's Day", chinese(1, 1), until(2011), day_preceding},
    {"Lunar New Year's Day", chinese(1, 1), since(2012), sunday_to_free},
    {"Second day of Lunar New Year", chinese(1, 2), always, day_following},
    {"Third day of Lunar New Year", chinese(1, 3), always, day_following},
    {"Ching Ming Festival", qingming, always, day_following},
    {"Good Friday", easter(-2)},
    {"Day following Good Friday", easter(-1)},
    {"Easter Monday", easter(1), always, day_following},
    {"Birthday of the Buddha", chinese(4, 8), always, day_following},
    {"Labour Day", on(5, 1), always, day_following},
    {"Tuen Ng Festival", chinese(5, 5), always, day_following},
    {"Establishment Day", on(7, 1), always, day_following},
    {"Day following Mid-Autumn", chinese(8, 16), until(2011), moved_to_day_preceding},
    {"Day following Mid-Autumn", chinese(8, 16), since(2012), day_following},
    {"Victory in the war of resistance", on(9, 3), only(2015)},
    {"National Day", on(10, 1), always, day_following},
    {"Chung Yeung Festival", chinese(9, 9), always, day_following},
    {"Christmas Day", on(12, 25), always, sunday_to_free},
    {"Weekday after Christmas", on(12, 26), always, day_following},
};

constexpr Row japan[] = {
    {"New Year's Day", on(1, 1), always, sunday_to_free},
    {"Coming of Age Day", nth(2, monday, 1)},
    {"Foundation Day", on(2, 11), always, sunday_to_free},
    {"Emperor's Birthday", on(2, 23), since(2020), sunday_to_free},
    {"Vernal Equinox Day", spring_equinox, always, sunday_to_free},
    {"Showa Day", on(4, 29), always, sunday_to_free},
    {"Enthronement", on(5, 1), only(2019)},
    {"Constitution Day", on(5, 3), always, sunday_to_free},
    {"Greenery Day", on(5, 4), since(2007), sunday_to_free},
    {"Children's Day", on(5, 5), always, sunday_to_free},
    {"Marine Day", on(7, 20), until(2002)},
    {"Marine Day", nth(3, monday, 7), {2003, 2019}},
    {"Marine Day", on(7, 23), only(2020)},
    {"Marine Day", on(7, 22), only(2021)},
    {"Marine Day", nth(3, monday, 7), since(2022)},
    {"Mountain Day", on(8, 11), {2016, 2019}, sunday_to_free},
    {"Mountain Day", on(8, 10), only(2020)},
    {"Mountain Day", on(8, 8), only(2021), sunday_to_free},
    {"Mountain Day", on(8, 11), since(2022), sunday_to_free},
    {"Respect for the Aged Day", on(9, 15), until(2002), sunday_to_free},
    {"Respect for the Aged Day", nth(3, monday, 9), since(2003)},
    {"Autumnal Equinox Day", autumn_equinox, always, sunday_to_free},
    {"Sports Day", nth(2, monday, 10), until(2019)},
    {"Sports Day", on(7, 24), only(2020)},
    {"Sports Day", on(7, 23), only(2021)},
    {"Sports Day", nth(2, monday, 10), since(2022)},
    {"Enthronement Ceremony", on(10, 22), only(2019)},
    {"Culture Day", on(11, 3), always, sunday_to_free},
    {"Labour Thanksgiving Day", on(11, 23), always, sunday_to_free},
    {"Emperor's Birthday", on(12, 23), until(2018), sunday_to_free},
    {"Citizens' Holiday", between_holidays},
};

/// A Sunday, or a day with another holiday: the next day that is free.
constexpr Substitute korean_feast{
    .shift = {0, 0, 0, 0, 0, 0, 1}, .to_free = true, .when_taken = true};
constexpr Substitute korean_day{
    .shift = {0, 0, 0, 0, 0, 2, 1}, .to_free = true, .when_taken = true};
constexpr Years with_feasts = since(2014), without_feasts = until(2013);
constexpr Years with_days = since(2021), without_days = until(2020);

/// Elections, and days that the government declared.
constexpr int korea_single[] = {
    20100602, 20120411, 20121219, 20140604, 20150814, 20160413, 20160506, 20170509,
    20171002, 20180613, 20200415, 20200817, 20220309, 20220601, 20231002, 20240410,
    20241001, 20250127, 20250603, 20260603, 20280412, 20300327, 20300612};

constexpr Row korea[] = {
    {"New Year's Day", on(1, 1)},
    {"Seollal's Eve", korean(1, 1).plus(-1), without_feasts},
    {"Seollal", korean(1, 1), without_feasts},
    {"Day after Seollal", korean(1, 2), without_feasts},
    {"Seollal's Eve", korean(1, 1).plus(-1), with_feasts, korean_feast},
    {"Seollal", korean(1, 1), with_feasts, korean_feast},
    {"Day after Seollal", korean(1, 2), with_feasts, korean_feast},
    {"Independence Movement Day", on(3, 1), until(2021)},
    {"Independence Movement Day", on(3, 1), since(2022), korean_day},
    {"Labour Day", on(5, 1), since(2026), korean_day},
    {"Children's Day", on(5, 5), without_feasts},
    {"Children's Day", on(5, 5), with_feasts, korean_day},
    {"Buddha's Birthday", korean(4, 8), until(2022)},
    {"Buddha's Birthday", korean(4, 8), since(2023), korean_day},
    {"Memorial Day", on(6, 6)},
    {"Constitution Day", on(7, 17), since(2026), korean_day},
    {"Liberation Day", on(8, 15), without_days},
    {"Liberation Day", on(8, 15), with_days, korean_day},
    {"Chuseok's Eve", korean(8, 14), without_feasts},
    {"Chuseok", korean(8, 15), without_feasts},
    {"Day after Chuseok", korean(8, 16), without_feasts},
    {"National Foundation Day", on(10, 3), without_days},
    {"Chuseok's Eve", korean(8, 14), with_feasts, korean_feast},
    {"Chuseok", korean(8, 15), with_feasts, korean_feast},
    {"Day after Chuseok", korean(8, 16), with_feasts, korean_feast},
    {"National Foundation Day", on(10, 3), with_days, korean_day},
    {"Hangul Day", on(10, 9), {2013, 2020}},
    {"Hangul Day", on(10, 9), with_days, korean_day},
    {"Christmas Day", on(12, 25), until(2022)},
    {"Christmas Day", on(12, 25), since(2023), korean_day},
    {"Day by decree or election", listed(korea_single)},
};

/// The rule of 2015: Saturday to Friday, Sunday to Monday; the New Year to the next free
/// weekday.
constexpr Years with_rule = since(2015), without_rule = until(2014);
constexpr Substitute taiwan_day{.shift = {0, 0, 0, 0, 0, -1, 1}};
constexpr Substitute taiwan_sunday{.shift = {0, 0, 0, 0, 0, -1, 1}, .to_free = true};
/// Where it meets Qingming: the day before, or after a Thursday.
constexpr int taiwan_children[] = {20130405, 20160405, 20170403, 20200402, 20210402,
                                   20240405, 20250403, 20280403, 20290403};

constexpr int taiwan_bridges[] = {
    20100219, 20120127, 20120227, 20121231, 20130215, 20130920, 20150102, 20160212,
    20160610, 20160916, 20170227, 20170529, 20171009, 20180406, 20181231, 20190208,
    20190301, 20191011, 20200123, 20200626, 20201002, 20210210, 20210920, 20220204,
    20230120, 20230127, 20230227, 20230403, 20230623, 20231009, 20240208, 20250127};

constexpr Row taiwan[] = {
    {"Founding Day", on(1, 1), without_rule},
    {"Founding Day", on(1, 1), with_rule, taiwan_day},
    {"Day before the Lunar Eve", chinese(1, 1).plus(-2), since(2026), weekend_to_free},
    {"Lunar New Year's Eve", chinese(1, 1).plus(-1), always, weekend_to_free},
    {"Lunar New Year", chinese(1, 1), always, weekend_to_free},
    {"Lunar New Year", chinese(1, 2), always, weekend_to_free},
    {"Lunar New Year", chinese(1, 3), always, weekend_to_free},
    {"Peace Memorial Day", on(2, 28), without_rule},
    {"Peace Memorial Day", on(2, 28), with_rule, taiwan_day},
    {"Children's Day", on(4, 4), {2011, 2014}},
    {"Children's Day", on(4, 4), with_rule, taiwan_sunday},
    {"Tomb Sweeping Day", qingming, without_rule},
    {"Tomb Sweeping Day", qingming, with_rule, taiwan_day},
    {"Children's Day", listed(taiwan_children)},
    {"Labour Day", on(5, 1), until(2025)},
    {"Labour Day", on(5, 1), since(2026), taiwan_day},
    {"Dragon Boat Festival", chinese(5, 5), without_rule},
    {"Dragon Boat Festival", chinese(5, 5), with_rule, taiwan_day},
    {"Mid-Autumn Festival", chinese(8, 15), without_rule},
    {"Mid-Autumn Festival", chinese(8, 15), with_rule, taiwan_day},
    {"Teachers' Day", on(9, 28), since(2025), taiwan_day},
    {"National Day", on(10, 10), without_rule},
    {"National Day", on(10, 10), with_rule, taiwan_day},
    {"Retrocession Day", on(10, 25), since(2025), taiwan_day},
    {"Constitution Day", on(12, 25), since(2025), taiwan_day},
    {"Bridge by decree", listed(taiwan_bridges)},
};
// clang-format on

constexpr Country countries_of_east_asia[] = {
    {.code = "CN", .name = "China", .rows = china, .first_year = 2010},
    {"HK", "Hong Kong", hong_kong},
    {"JP", "Japan", japan},
    {.code = "KR", .name = "South Korea", .rows = korea, .first_year = 2010},
    {.code = "TW", .name = "Taiwan", .rows = taiwan, .first_year = 2011},
};

}  // namespace

std::span<const Country> east_asia() {
    return countries_of_east_asia;
}

}  // namespace bemcal::holidays
