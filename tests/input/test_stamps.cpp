#include "base/error.hpp"
#include "input/series.hpp"
#include "input/stamps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using physics::format_time;

std::vector<std::string> begins(const std::string& text, const input::StampRules& rules) {
    const input::Csv csv = input::parse_csv(text, "x.csv");
    std::vector<std::string> times;
    for (const physics::Seconds begin : input::stamps_in(csv, 0, rules).begins)
        times.push_back(format_time(begin).substr(0, 16));
    return times;
}

using Times = std::vector<std::string>;

TEST(Stamps, AnEndIsBroughtToTheBeginOfItsHour) {
    input::StampRules rules;
    rules.at_end = true;
    EXPECT_EQ(begins("t,x\n2021-01-01 01:00,1\n2021-01-01 02:00,1\n", rules),
              (Times{"2021-01-01 00:00", "2021-01-01 01:00"}));
}

TEST(Stamps, UtcIsBroughtToTheSitesClock) {
    input::StampRules rules;
    rules.site_offset_h = 8;
    EXPECT_EQ(begins("t,x\n2020-12-31T20:00:00Z,1\n2020-12-31T21:00:00Z,1\n", rules),
              (Times{"2021-01-01 04:00", "2021-01-01 05:00"}));
    EXPECT_EQ(begins("t,x\n2021-01-01 00:00+01:00,1\n", rules),
              (Times{"2021-01-01 07:00"}));
    rules.file_offset_h = -5;  // by the job
    EXPECT_EQ(begins("t,x\n2021-01-01 00:00,1\n", rules), (Times{"2021-01-01 13:00"}));
}

// Central Europe, 2021: 2:00 to 3:00 does not exist on 28 March and comes twice on 31
// October.
TEST(Stamps, WallClockOfTheEuBecomesStandardTimeWithoutGapOrRepetition) {
    input::StampRules rules;
    rules.clock = input::Clock::eu;
    rules.site_offset_h = rules.file_offset_h = 1;
    EXPECT_EQ(begins("t,x\n2021-03-28 01:00,1\n2021-03-28 03:00,1\n2021-03-28 04:00,1\n",
                     rules),
              (Times{"2021-03-28 01:00", "2021-03-28 02:00", "2021-03-28 03:00"}));
    EXPECT_EQ(begins("t,x\n2021-10-31 01:00,1\n2021-10-31 02:00,1\n2021-10-31 02:00,1\n"
                     "2021-10-31 03:00,1\n",
                     rules),
              (Times{"2021-10-31 00:00", "2021-10-31 01:00", "2021-10-31 02:00",
                     "2021-10-31 03:00"}));
}

TEST(Stamps, WallClockEndStampsBecomeTheSameHours) {
    input::StampRules rules;
    rules.clock = input::Clock::us;
    rules.at_end = true;
    rules.site_offset_h = rules.file_offset_h = -7;  // Denver, 14 March 2021
    EXPECT_EQ(begins("t,x\n2021-03-14 01:00,1\n2021-03-14 02:00,1\n2021-03-14 04:00,1\n"
                     "2021-03-14 05:00,1\n",
                     rules),
              (Times{"2021-03-14 00:00", "2021-03-14 01:00", "2021-03-14 02:00",
                     "2021-03-14 03:00"}));
}

std::string quarters(const std::vector<const char*>& stamps) {
    std::string text = "t,x\n";
    for (const char* stamp : stamps) text += std::string(stamp) + ",1\n";
    return text;
}

// Ends of quarters as instants: in spring 01:45 is followed by 03:00, in autumn 02:45 of
// summer time by 02:00.
TEST(Stamps, EndsOfQuartersByTheWallClockAreInstants) {
    input::StampRules rules;
    rules.clock = input::Clock::eu;
    rules.at_end = true;
    rules.site_offset_h = rules.file_offset_h = 1;
    EXPECT_EQ(begins(quarters({"2021-03-28 01:30", "2021-03-28 01:45", "2021-03-28 03:00",
                               "2021-03-28 03:15"}),
                     rules),
              (Times{"2021-03-28 01:15", "2021-03-28 01:30", "2021-03-28 01:45",
                     "2021-03-28 02:00"}));
    EXPECT_EQ(begins(quarters({"2021-10-31 02:30", "2021-10-31 02:45", "2021-10-31 02:00",
                               "2021-10-31 02:15", "2021-10-31 02:30", "2021-10-31 02:45",
                               "2021-10-31 03:00", "2021-10-31 03:15"}),
                     rules),
              (Times{"2021-10-31 01:15", "2021-10-31 01:30", "2021-10-31 01:45",
                     "2021-10-31 02:00", "2021-10-31 02:15", "2021-10-31 02:30",
                     "2021-10-31 02:45", "2021-10-31 03:00"}));
}

// A meter that adds a quarter to the wall clock's begin: 02:00 in spring, and in autumn
// 03:00 twice.
TEST(Stamps, EndsThatAddAStepToTheWallClockAreReadAsWell) {
    input::StampRules rules;
    rules.clock = input::Clock::eu;
    rules.at_end = true;
    rules.site_offset_h = rules.file_offset_h = 1;
    EXPECT_EQ(begins(quarters({"2021-03-28 01:45", "2021-03-28 02:00", "2021-03-28 03:15",
                               "2021-03-28 03:30"}),
                     rules),
              (Times{"2021-03-28 01:30", "2021-03-28 01:45", "2021-03-28 02:00",
                     "2021-03-28 02:15"}));
    EXPECT_EQ(begins(quarters({"2021-10-31 02:45", "2021-10-31 03:00", "2021-10-31 02:15",
                               "2021-10-31 02:30", "2021-10-31 02:45", "2021-10-31 03:00",
                               "2021-10-31 03:15"}),
                     rules),
              (Times{"2021-10-31 01:30", "2021-10-31 01:45", "2021-10-31 02:00",
                     "2021-10-31 02:15", "2021-10-31 02:30", "2021-10-31 02:45",
                     "2021-10-31 03:00"}));
}

TEST(Stamps, OffsetsInAFormOfStrptimeAreApplied) {
    input::StampRules rules;
    rules.site_offset_h = rules.file_offset_h = 1;
    rules.format = "%d.%m.%Y %H:%M %z";
    EXPECT_EQ(begins("t,x\n28.03.2021 01:00 +0100,1\n28.03.2021 03:00 +0200,1\n"
                     "28.03.2021 02:00 GMT,1\n",
                     rules),
              (Times{"2021-03-28 01:00", "2021-03-28 02:00", "2021-03-28 03:00"}));
    rules.format = "%s";
    EXPECT_EQ(begins("t,x\n1614952800,1\n1614956400,1\n", rules),
              (Times{"2021-03-05 15:00", "2021-03-05 16:00"}));
}

TEST(Stamps, AZoneOfAnotherContinentIsNotGuessed) {
    input::StampRules rules;
    rules.site_offset_h = rules.file_offset_h = 8;  // China Standard Time is CST, too
    EXPECT_THROW(begins("t,x\n2021-03-05 14:00 CST,1\n", rules), UserError);
    rules.site_offset_h = rules.file_offset_h = -6;
    EXPECT_EQ(begins("t,x\n2021-03-05 14:00 CST,1\n", rules),
              (Times{"2021-03-05 14:00"}));
}

/// Whether stamps of a step from a first one on, n of them, are found to be ends.
bool are_ends(const char* first, int step_s, int n, double utc_offset_h = 0,
              const std::string& offset = "") {
    std::string text = "t,x\n";
    const physics::Seconds start = physics::parse_time(first);
    for (int k = 0; k < n; ++k)
        text += format_time(start + std::chrono::seconds(k * step_s)) + offset + ",1\n";
    const input::Csv csv = input::parse_csv(text, "x.csv");
    input::StampRules rules;
    rules.is_said = false;
    rules.site_offset_h = utc_offset_h;
    rules.file_offset_h = offset.empty() ? 0 : utc_offset_h;
    return input::stamps_in(csv, 0, rules).at_end;
}

TEST(Stamps, StampsThatCloseWholeDaysAreEnds) {
    EXPECT_TRUE(are_ends("2021-01-01 01:00", 3600, 72));
    EXPECT_TRUE(are_ends("2021-01-01 00:15", 900, 96));
    EXPECT_TRUE(are_ends("2021-01-01 00:59:59", 3600, 72));
    EXPECT_FALSE(are_ends("2021-01-01 00:00", 3600, 72));
    EXPECT_FALSE(are_ends("2021-01-01 01:00", 3600, 60));
    EXPECT_FALSE(are_ends("2021-01-01 00:30", 900, 96));
    // UTC whose days are whole by the site's clock, an hour before it.
    EXPECT_FALSE(are_ends("2021-01-01 01:00", 3600, 72, -1));
    // Whole days of UTC, written by the clock of Paris.
    EXPECT_FALSE(are_ends("2021-01-01 01:00", 3600, 72, 1, "+01:00"));
    EXPECT_TRUE(are_ends("2021-01-01 01:00", 3600, 72, 1));
    // Days of Guangzhou in UTC: 00:15 there, or 01:00, to midnight.
    EXPECT_TRUE(are_ends("2020-12-31 16:15", 900, 96, 8, "+00:00"));
    EXPECT_TRUE(are_ends("2020-12-31 17:00", 3600, 72, 8, "+00:00"));
    EXPECT_FALSE(are_ends("2020-12-31 16:00", 3600, 72, 8, "+00:00"));
    // Ends by the site's clock, but as begins whole days of the clock they are written
    // by.
    EXPECT_FALSE(are_ends("2021-01-01 00:00", 3600, 72, 1, "+00:00"));
    EXPECT_FALSE(are_ends("2021-01-01 00:00", 3600, 72, 2, "+01:00"));
    EXPECT_FALSE(are_ends("2021-01-01 00:00", 3600, 72, 1));
}

// A day's sum written just before midnight is of that day.
TEST(Stamps, LastMinutesOfDaysAreOfTheDaysThatTheyStandIn) {
    for (const std::string clock : {"23:59", "23:59:59", "23:30"}) {
        std::string text = "t,x\n";
        for (const char* day : {"04", "05", "06"})
            text += std::string("2021-01-") + day + " " + clock + ",1\n";
        input::StampRules rules;
        rules.is_said = false;
        EXPECT_EQ(begins(text, rules),
                  (Times{"2021-01-04 00:00", "2021-01-05 00:00", "2021-01-06 00:00"}))
            << clock;
        const input::Csv csv = input::parse_csv(text, "x.csv");
        EXPECT_EQ(input::stamps_in(csv, 0, rules).notes.at(0).finding,
                  "its stamps are the last minutes of days");
        rules.is_count = true;  // a register at the end of the 4th
        EXPECT_EQ(begins(text, rules)[0], "2021-01-05 00:00");
        rules.is_count = false;
        rules.is_said = true;  // as begins
        EXPECT_EQ(begins(text, rules)[0], "2021-01-05 00:00");
    }
}

TEST(Stamps, AnHourThatTheWallClockSkipsIsAnError) {
    input::StampRules rules;
    rules.clock = input::Clock::eu;
    rules.site_offset_h = rules.file_offset_h = 1;
    EXPECT_THROW(begins("t,x\n2021-03-28 01:00,1\n2021-03-28 02:00,1\n", rules),
                 UserError);
}

TEST(Stamps, AnHourMissingOnAnotherDayIsAGapAndNoClockChange) {
    const std::string text =
        "t,x\n2021-04-11 01:00,1\n2021-04-11 03:00,1\n2021-04-11 04:00,1\n";
    const input::Csv csv = input::parse_csv(text, "x.csv");
    const input::RegularSeries series =
        input::lay(csv, input::stamps_in(csv, 0, {}), {1, 2, 3});
    ASSERT_EQ(series.gaps.size(), 1U);
    EXPECT_EQ(input::words_of(series.gaps[0], series.axis),
              "1 h from 2021-04-11 02:00:00");
    EXPECT_EQ(series.values.size(), 4U);
}

TEST(Stamps, FormatsOfSpreadsheetsAreReadByStrptime) {
    input::StampRules rules;
    rules.format = "%d/%m/%Y %H:%M";
    EXPECT_EQ(begins("t,x\n31/12/2020 23:00,1\n", rules), (Times{"2020-12-31 23:00"}));
    EXPECT_THROW(input::parse_stamp("31/13/2020 23:00", rules.format),
                 std::invalid_argument);
}

TEST(Stamps, TheYearFirstIsReadWithoutAForm) {
    for (const char* text :
         {"2021-03-05 14:00", "2021-03-05T14:00:00.000", "2021-3-5 14:00",
          "2021/03/05 14:00", "20210305T1400", "20210305:1400", "2021-03-05 14:00:00,5"})
        EXPECT_EQ(format_time(input::parse_stamp(text).face), "2021-03-05 14:00:00")
            << text;
}

TEST(Stamps, ThingsThatAreNoTimesAreRefused) {
    for (const char* text :
         {"", "2021", "2021-02-30", "2021-02-03 25:00", "2021-02-03 10:60",
          "2021-02-03 10:00:61", "2021-02-03 10:00 am", "2021-02-03X10:00",
          "2021-02-03 10:00+99:00", "20210203", "2021-02-03 24:30", "03/02/2021 10:00"})
        EXPECT_THROW(input::parse_stamp(text), std::invalid_argument) << text;
}

TEST(Series, ShortGapsBecomeStraightLinesAndLongOnesStay) {
    const double nan = std::nan("");
    std::vector<double> values{nan, 1, nan, nan, 4, nan, nan, nan, 8, nan};
    EXPECT_EQ(input::fill_gaps(values, 2), 2);
    EXPECT_EQ(values[2], 2);
    EXPECT_EQ(values[3], 3);
    EXPECT_TRUE(std::isnan(values[5]) && std::isnan(values[0]) && std::isnan(values[9]));
}

}  // namespace
}  // namespace bemcal::job
