#include "input/time_format.hpp"

#include <cstdlib>
#include <ctime>

#include <gtest/gtest.h>

namespace bemcal::input {
namespace {

using physics::format_time;
using std::chrono::seconds;

/// "2021-03-05 14:00:00", with " +3600" where the text says an offset; "" = refused.
std::string read(const char* text, const char* format) {
    const auto stamp = read_time(text, format);
    if (!stamp) return "";
    return format_time(stamp->face) +
           (stamp->offset ? " " + std::to_string(stamp->offset->count()) : "");
}

TEST(TimeFormat, DatesAndTimesOfDayAreReadAsStrptimeDocuments) {
    EXPECT_EQ(read("05.03.2021 14:07", "%d.%m.%Y %H:%M"), "2021-03-05 14:07:00");
    EXPECT_EQ(read("3/5/2021 4:07", "%m/%d/%Y %H:%M"), "2021-03-05 04:07:00");
    EXPECT_EQ(read("20210305:1410", "%Y%m%d:%H%M"), "2021-03-05 14:10:00");
    EXPECT_EQ(read("5 March 21", "%d %B %y"), "2021-03-05 00:00:00");
    EXPECT_EQ(read("Fri Mar  5 14:07:09 1971", "%c"), "1971-03-05 14:07:09");
    EXPECT_EQ(read("64 2021 14", "%j %Y %H"), "2021-03-05 14:00:00");
    EXPECT_EQ(read("2021-03", "%Y-%m"), "2021-03-01 00:00:00");
    EXPECT_EQ(read("03/05/21 14:07:09.250", "%D %T.%f"), "2021-03-05 14:07:09");
    EXPECT_EQ(read("5.3.2021", "%-d.%-m.%Y"), "2021-03-05 00:00:00");
}

TEST(TimeFormat, TwelveHoursHaveTheirNoonAndMidnight) {
    constexpr const char* format = "%m/%d/%Y %I:%M %p";
    EXPECT_EQ(read("03/05/2021 12:00 AM", format), "2021-03-05 00:00:00");
    EXPECT_EQ(read("03/05/2021 12:15 pm", format), "2021-03-05 12:15:00");
    EXPECT_EQ(read("03/05/2021 1:00 p.m.", format), "2021-03-05 13:00:00");
    EXPECT_EQ(read("03/05/2021 1:00\xE2\x80\xAFPM", format), "2021-03-05 13:00:00");
    EXPECT_EQ(read("03/05/2021 13:00 PM", format), "");
    // %H beside %p: what is written is meant.
    EXPECT_EQ(read("03/05/2021 01:00 PM", "%m/%d/%Y %H:%M %p"), "2021-03-05 13:00:00");
    EXPECT_EQ(read("03/05/2021 13:00 AM", "%m/%d/%Y %H:%M %p"), "");
}

TEST(TimeFormat, OffsetsAreReadInEveryNotation) {
    for (const char* text :
         {"5.3.2021 14:00 +0100", "5.3.2021 14:00 +01:00", "5.3.2021 14:00+01",
          "5.3.2021 14:00 UTC+1", "5.3.2021 14:00 CET"})
        EXPECT_EQ(read(text, "%d.%m.%Y %H:%M %z"), "2021-03-05 14:00:00 3600") << text;
    for (const char* text : {"5.3.2021 14:00 Z", "5.3.2021 14:00 GMT",
                             "5.3.2021 14:00 UTC", "5.3.2021 14:00 +0000"})
        EXPECT_EQ(read(text, "%d.%m.%Y %H:%M %Z"), "2021-03-05 14:00:00 0") << text;
    EXPECT_EQ(read("5.3.2021 14:00 -0530", "%d.%m.%Y %H:%M %z"),
              "2021-03-05 14:00:00 -19800");
    EXPECT_EQ(read("5.3.2021 14:00 +99:00", "%d.%m.%Y %H:%M %z"), "");
    EXPECT_EQ(read("5.3.2021 14:00 XYZ", "%d.%m.%Y %H:%M %Z"), "");
}

TEST(TimeFormat, SecondsSince1970AreUtcWhateverTheMachinesZone) {
    // 2021-03-05 14:00 UTC
    const char* before = std::getenv("TZ");
    const std::string kept = before != nullptr ? before : "";
    for (const char* zone : {"America/Denver", "Asia/Kolkata", "UTC"}) {
        setenv("TZ", zone, 1);
        tzset();
        EXPECT_EQ(read("1614952800", "%s"), "2021-03-05 14:00:00 0") << zone;
        EXPECT_EQ(read("1614952800123", "%s"), "2021-03-05 14:00:00 0") << zone;
        EXPECT_EQ(read("1614952800.5", "%s"), "2021-03-05 14:00:00 0") << zone;
    }
    before != nullptr ? setenv("TZ", kept.c_str(), 1) : unsetenv("TZ");
    tzset();
}

TEST(TimeFormat, TwentyFourHoursAreTheNextDaysMidnight) {
    EXPECT_EQ(read("31.12.2021 24:00", "%d.%m.%Y %H:%M"), "2022-01-01 00:00:00");
    EXPECT_EQ(read("31.12.2021 24:01", "%d.%m.%Y %H:%M"), "");
    EXPECT_TRUE(read_time("31.12.2021 24:00", "%d.%m.%Y %H:%M")->is_24);
}

TEST(TimeFormat, WhatIsNoDayOfTheCalendarIsRefused) {
    EXPECT_EQ(read("30.02.2021", "%d.%m.%Y"), "");
    EXPECT_EQ(read("366 2021", "%j %Y"), "");
    EXPECT_EQ(read("05.13.2021", "%d.%m.%Y"), "");
    EXPECT_EQ(read("05.03.2021 x", "%d.%m.%Y"), "");
}

TEST(TimeFormat, AFormWithoutAYearOrOfUnknownConversionsIsNone) {
    EXPECT_NO_THROW(check_time_format("%d/%m/%Y %H:%M"));
    EXPECT_NO_THROW(check_time_format("%s"));
    EXPECT_THROW(check_time_format("%d/%m %H:%M"), std::invalid_argument);
    EXPECT_THROW(check_time_format("%Y-%Q"), std::invalid_argument);
    EXPECT_THROW(check_time_format("%Y-%W"), std::invalid_argument);
    EXPECT_THROW(check_time_format("%Y%"), std::invalid_argument);
}

TEST(TimeFormat, AClockOfItsOwnIsReadInItsNotations) {
    const auto clock = [](const char* text) {
        return read_clock(text).value_or(seconds(-1)).count();
    };
    EXPECT_EQ(clock("14:30"), 52200);
    EXPECT_EQ(clock("14:30:05"), 52205);
    EXPECT_EQ(clock("2:30 PM"), 52200);
    EXPECT_EQ(clock("1430"), 52200);
    EXPECT_EQ(clock("15"), 54000);
    EXPECT_EQ(clock("24:00"), 86400);
    EXPECT_EQ(clock("0015"), 900);
    EXPECT_EQ(clock("25:00"), -1);
    EXPECT_EQ(clock("14:3x"), -1);
    EXPECT_EQ(clock("0.5"), -1);
}

}  // namespace
}  // namespace bemcal::input
