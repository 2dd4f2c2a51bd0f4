/// Time axes, dates and summer time.
#include "physics/calendar.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

TEST(TimeAxis, StepsAreFoundByTimeAlsoOutside) {
    const TimeAxis axis{parse_time("2021-01-01"), 600, 12};
    EXPECT_EQ(axis.step_of(axis.start), 0);
    EXPECT_EQ(axis.step_of(parse_time("2021-01-01 00:09:59")), 0);
    EXPECT_EQ(axis.step_of(parse_time("2021-01-01 00:10")), 1);
    EXPECT_EQ(axis.step_of(parse_time("2020-12-31 23:59:59")), -1);
    EXPECT_EQ(axis.step_of(axis.end()), 12);
    EXPECT_EQ(format_time(axis.end()), "2021-01-01 02:00:00");
    EXPECT_LT(axis.step_of(parse_time("0001-01-01")), 0);
    EXPECT_GT(axis.step_of(parse_time("9999-01-01")), 12);
}

TEST(TimeAxis, BetweenKeepsWholeStepsAndIsCut) {
    const TimeAxis axis{parse_time("2021-01-01"), 3600, 24};
    const TimeAxis part =
        axis.between(parse_time("2021-01-01 05:30"), parse_time("2021-01-01 08:59"));
    EXPECT_EQ(format_time(part.start), "2021-01-01 06:00:00");
    EXPECT_EQ(part.n_steps, 2);
    EXPECT_EQ(part.step_s, 3600);
    EXPECT_EQ(axis.between(parse_time("2020-01-01"), parse_time("2022-01-01")).n_steps,
              24);
    EXPECT_EQ(axis.between(parse_time("2022-01-01"), parse_time("2023-01-01")).n_steps,
              0);
    EXPECT_EQ(axis.between(parse_time("2021-01-01 09:00"), parse_time("2021-01-01 08:00"))
                  .n_steps,
              0);
}

TEST(CalendarStep, NamesOfAnHour) {
    const CalendarStep step = calendar_step(parse_time("2024-12-31 23:50"));
    EXPECT_EQ(step.year, 2024);
    EXPECT_EQ(step.month, 12);
    EXPECT_EQ(step.day, 31);
    EXPECT_EQ(step.hour, 23);
    EXPECT_EQ(step.weekday, 1);  // a Tuesday
    EXPECT_EQ(step.day_of_year, 366);
    EXPECT_EQ(calendar_step(parse_time("2023-01-01")).weekday, 6);  // a Sunday
    EXPECT_EQ(calendar_step(parse_time("1969-07-20 20:17")).hour, 20);
}

TEST(ParseTime, Notations) {
    const Seconds noon =
        std::chrono::sys_days(std::chrono::year(2021) / 3 / 5) + std::chrono::hours(12);
    EXPECT_EQ(parse_time("2021-03-05 12:00"), noon);
    EXPECT_EQ(parse_time("2021-03-05T12:00:00"), noon);
    EXPECT_EQ(parse_time("2021-03-05"), noon - std::chrono::hours(12));
    EXPECT_EQ(parse_time("2021-03-04 24:00"), parse_time("2021-03-05"));
    EXPECT_EQ(format_time(noon), "2021-03-05 12:00:00");
    EXPECT_EQ(format_date(noon), "2021-03-05");
}

TEST(ParseTime, RefusesWhatIsNotATime) {
    for (const char* text :
         {"", "2021", "5.3.2021", "2021-3-5", "2021-13-01", "2021-02-29",
          "2021-03-05 25:00", "2021-03-05 12:60", "2021-03-05 24:01", "2021-03-05 12",
          "2021-03-05 12:00Z", "2021-03-05T12:00:00+01:00", "2021-03-05x12:00", "03-05"})
        EXPECT_THROW(parse_time(text), std::invalid_argument) << text;
}

TEST(ParseTime, SaysWhatWasExpected) {
    try {
        parse_time("5.3.2021");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("2021-03-05 14:30"), std::string::npos);
    }
}

bool holds(const char* range, const char* day) {
    return parse_date_range(range).contains(calendar_step(parse_time(day)));
}

TEST(DateRange, BothDaysCount) {
    EXPECT_FALSE(holds("2021-12-24/2022-01-02", "2021-12-23 23:00"));
    EXPECT_TRUE(holds("2021-12-24/2022-01-02", "2021-12-24"));
    EXPECT_TRUE(holds("2021-12-24/2022-01-02", "2022-01-02 23:00"));
    EXPECT_FALSE(holds("2021-12-24/2022-01-02", "2022-01-03"));
    EXPECT_TRUE(holds("2021-12-24", "2021-12-24 12:00"));
    EXPECT_FALSE(holds("2021-12-24", "2020-12-24"));
}

TEST(DateRange, YearlyOnesWrapTheNewYear) {
    for (const char* day : {"2019-12-24", "2019-12-31", "2020-01-01", "2020-01-02"})
        EXPECT_TRUE(holds("12-24/01-02", day)) << day;
    for (const char* day : {"2019-12-23", "2020-01-03", "2020-07-01"})
        EXPECT_FALSE(holds("12-24/01-02", day)) << day;
    EXPECT_TRUE(holds("07-04", "1999-07-04"));
    EXPECT_TRUE(holds("02-29", "2020-02-29"));
}

TEST(DateRange, RefusesWhatIsNotARange) {
    for (const char* text :
         {"", "/", "12-24/", "13-01", "02-30", "2021-02-29", "12-24/2022-01-02",
          "2022-01-02/2021-12-24", "12-24-01-02", "2021-12-24/2021-12-25/x"})
        EXPECT_THROW(parse_date_range(text), std::invalid_argument) << text;
}

TEST(SummerTime, EuropeanUnionChangesAtOneUtc) {
    // 2021: 28 March to 31 October; in Estonia (UTC+2) at 3:00 local standard time.
    EXPECT_FALSE(is_summer_time(parse_time("2021-03-28 02:59"), "eu", 2));
    EXPECT_TRUE(is_summer_time(parse_time("2021-03-28 03:00"), "eu", 2));
    EXPECT_TRUE(is_summer_time(parse_time("2021-10-31 02:59"), "eu", 2));
    EXPECT_FALSE(is_summer_time(parse_time("2021-10-31 03:00"), "eu", 2));
    EXPECT_TRUE(is_summer_time(parse_time("2021-03-28 01:00"), "eu", 0));
}

TEST(SummerTime, UnitedStatesChangeAtTwoByTheClock) {
    // 2021: 14 March to 7 November
    EXPECT_FALSE(is_summer_time(parse_time("2021-03-14 01:59"), "us", -7));
    EXPECT_TRUE(is_summer_time(parse_time("2021-03-14 02:00"), "us", -7));
    EXPECT_TRUE(is_summer_time(parse_time("2021-11-07 00:59"), "us", -7));
    EXPECT_FALSE(is_summer_time(parse_time("2021-11-07 01:00"), "us", -7));
}

TEST(SummerTime, NoneAndUnknownRules) {
    EXPECT_FALSE(is_summer_time(parse_time("2021-07-01"), "none", 0));
    EXPECT_THROW(is_summer_time(parse_time("2021-07-01"), "EU", 0),
                 std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::physics
