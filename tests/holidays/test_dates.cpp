/// Days by rule, against published dates.
#include "holidays/dates.hpp"
#include "holidays/lunar.hpp"
#include "physics/calendar.hpp"

#include <gtest/gtest.h>

namespace bemcal::holidays {
namespace {

std::string shown(sys_days day) {
    return physics::format_date(day);
}

std::string only_day(const Rule& rule, int year) {
    const auto days = days_of(rule, year);
    return days.size() == 1 ? shown(days[0]) : "none, or several";
}

TEST(Easter, IsThePublishedSunday) {
    for (const char* date : {"2000-04-23", "2008-03-23", "2011-04-24", "2016-03-27",
                             "2019-04-21", "2024-03-31", "2038-04-25"})
        EXPECT_EQ(shown(easter_sunday(std::stoi(date))), date);
}

TEST(Easter, OfTheOrthodoxChurchesIsThePublishedSunday) {
    for (const char* date : {"2010-04-04", "2013-05-05", "2016-05-01", "2017-04-16",
                             "2021-05-02", "2024-05-05", "2027-05-02"})
        EXPECT_EQ(shown(orthodox_easter_sunday(std::stoi(date))), date);
}

TEST(Rules, CountWeekdaysOfAMonth) {
    EXPECT_EQ(only_day(nth(4, thursday, 11), 2021), "2021-11-25");
    EXPECT_EQ(only_day(nth(1, monday, 9), 2025), "2025-09-01");
    EXPECT_EQ(only_day(last(monday, 5), 2021), "2021-05-31");
    EXPECT_EQ(only_day(last(monday, 8), 2022), "2022-08-29");
}

TEST(Rules, FindTheWeekdayAroundADate) {
    EXPECT_EQ(only_day(from(saturday, 6, 20), 2026), "2026-06-20");
    EXPECT_EQ(only_day(from(saturday, 6, 20), 2021), "2021-06-26");
    EXPECT_EQ(only_day(up_to(monday, 5, 24), 2021), "2021-05-24");
    EXPECT_EQ(only_day(up_to(wednesday, 11, 22), 2022), "2022-11-16");
    EXPECT_EQ(only_day(nearest(monday, 1, 29), 2021), "2021-02-01");
    EXPECT_EQ(only_day(nearest(monday, 1, 22), 2020), "2020-01-20");
}

TEST(Rules, GiveWayToEaster) {
    const Rule procession = from(thursday, 4, 1).unless_easter(-3, 7);
    EXPECT_EQ(only_day(procession, 2022), "2022-04-07");
    EXPECT_EQ(only_day(procession, 2023), "2023-04-13");
}

TEST(Rules, OfTheSunAreThePublishedDays) {
    EXPECT_EQ(only_day(spring_equinox, 2020), "2020-03-20");
    EXPECT_EQ(only_day(spring_equinox, 2023), "2023-03-21");
    EXPECT_EQ(only_day(autumn_equinox, 2024), "2024-09-22");
    EXPECT_EQ(only_day(autumn_equinox, 2022), "2022-09-23");
    EXPECT_EQ(only_day(qingming, 2020), "2020-04-04");
    EXPECT_EQ(only_day(qingming, 2022), "2022-04-05");
}

TEST(Rules, OfListsHaveNoDayInOtherYears) {
    constexpr int dates[] = {20200102, 20220304, 20220305};
    EXPECT_EQ(days_of(listed(dates), 2022).size(), 2U);
    EXPECT_EQ(days_of(listed(dates), 2021).size(), 0U);
}

TEST(LunarCalendars, BeginTheirYearsAsPublished) {
    for (const char* date : {"2004-01-22", "2010-02-14", "2015-02-19", "2020-01-25",
                             "2021-02-12", "2023-01-22", "2025-01-29", "2033-01-31"})
        EXPECT_EQ(only_day(chinese(1, 1), std::stoi(date)), date);
}

TEST(LunarCalendars, HaveTheirFeastsInLeapYearsToo) {
    EXPECT_EQ(only_day(chinese(5, 5), 2020), "2020-06-25");  // after leap month 4
    EXPECT_EQ(only_day(chinese(8, 15), 2020), "2020-10-01");
    EXPECT_EQ(only_day(chinese(8, 15), 2023), "2023-09-29");  // after leap month 2
    EXPECT_EQ(only_day(chinese(5, 5), 2025), "2025-05-31");   // before leap month 6
    EXPECT_EQ(only_day(chinese(9, 9), 2014), "2014-10-02");   // before leap month 9
    EXPECT_EQ(only_day(chinese(4, 8), 2022), "2022-05-08");
}

TEST(LunarCalendars, OfKoreaAndChinaDifferByADayIn2027) {
    EXPECT_EQ(only_day(korean(1, 1), 2027), "2027-02-07");
    EXPECT_EQ(only_day(chinese(1, 1), 2027), "2027-02-06");
    EXPECT_EQ(only_day(korean(1, 1), 2024), "2024-02-10");
    EXPECT_EQ(only_day(korean(8, 15), 2017), "2017-10-04");
}

TEST(LunarCalendars, HaveMonthsOf29Or30Days) {
    for (const LunarCalendar calendar : {LunarCalendar::chinese, LunarCalendar::korean})
        for (int year = first_lunar_year; year < last_lunar_year; ++year) {
            const auto begin = *lunar_date(calendar, year, 1, 1);
            const auto days = (*lunar_date(calendar, year + 1, 1, 1) - begin).count();
            EXPECT_TRUE((days >= 353 && days <= 355) || (days >= 383 && days <= 385))
                << year;
            const auto twelfth = (*lunar_date(calendar, year, 12, 1) - begin).count();
            EXPECT_TRUE(days - twelfth == 29 || days - twelfth == 30) << year;
        }
}

TEST(LunarCalendars, KnowNothingBeyondTheirTables) {
    EXPECT_FALSE(lunar_date(LunarCalendar::chinese, 1999, 1, 1));
    EXPECT_FALSE(lunar_date(LunarCalendar::korean, 2051, 1, 1));
}

}  // namespace
}  // namespace bemcal::holidays
