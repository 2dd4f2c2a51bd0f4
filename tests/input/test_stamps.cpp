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

TEST(Stamps, ThingsThatAreNoTimesAreRefused) {
    for (const char* text :
         {"", "2021", "2021-02-30", "2021-02-03 25:00", "2021-02-03 10:60",
          "2021-02-03 10:00:61", "2021-02-03 10:00 am", "2021-02-03X10:00",
          "2021-02-03 10:00+99:00", "20210203"})
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
