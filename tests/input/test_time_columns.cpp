#include "base/error.hpp"
#include "input/csv_numbers.hpp"
#include "input/series.hpp"
#include "input/stamps.hpp"

#include <gtest/gtest.h>

namespace bemcal::input {
namespace {

using physics::format_time;
using Names = std::vector<std::string>;
using Times = std::vector<std::string>;

Times times_of(const std::string& text, const Names& names = {},
               const std::string& format = "", bool is_said = true) {
    const Csv csv = parse_csv(text, "x.csv");
    StampRules rules;
    rules.format = format;
    rules.is_said = is_said;
    Times times;
    for (const auto begin :
         stamps_in(csv, time_columns(csv, names, format), rules).begins)
        times.push_back(format_time(begin).substr(0, 16));
    return times;
}

const Times two_hours = {"2021-03-05 13:00", "2021-03-05 14:00"};

TEST(TimeColumns, DateAndClockAreTakenTogether) {
    const std::string text = "date,time,x\n2021-03-05,13:00,1\n2021-03-05,14:00,2\n";
    EXPECT_EQ(times_of(text, {"date", "time"}), two_hours);
    EXPECT_EQ(times_of(text), two_hours);  // found
}

// Times by another clock, of an interval's other end, or when a row was written are none
// of another trend; 14 hours of distance, and 2 of change, are the edge.
TEST(TimeColumns, OfTrendsSideBySideAreTold) {
    const auto own = [](const std::string& rows, std::size_t column = 3) {
        const Csv csv = parse_csv(rows, "x.csv");
        return own_time_of(csv, time_columns(csv, {}, ""), column, "");
    };
    const std::string day = "t,a,u,b\n2021-03-05 10:00,1,2021-03-";
    EXPECT_EQ(own(day + "06 00:00,5\n2021-03-05 11:00,2,2021-03-06 01:00,6\n"),
              std::nullopt);
    EXPECT_EQ(own(day + "06 00:01,5\n2021-03-05 11:00,2,2021-03-06 01:01,6\n"), 2U);
    EXPECT_EQ(own(day + "05 10:15,5\n2021-03-05 11:00,2,2021-03-05 13:15,6\n"),
              std::nullopt);
    EXPECT_EQ(own(day + "05 10:15,5\n2021-03-05 11:00,2,2021-03-05 13:16,6\n"), 2U);
    EXPECT_EQ(own(day + "05 10:15,5\n2021-03-05 11:00,2,,\n"), std::nullopt);
    EXPECT_EQ(own("t,u,a,b\n2021-03-05 10:00,2021-03-07 10:00,1,2\n"), std::nullopt);
}

TEST(TimeColumns, AFormMayBeOfTheDateAloneOrOfBoth) {
    EXPECT_EQ(times_of("d;from;x\n05.03.2021;13:00:00;1\n05.03.2021;14:00:00;2\n", {},
                       "%d.%m.%Y"),
              two_hours);
    EXPECT_EQ(times_of("d;from;x\n05.03.2021;1 PM;1\n05.03.2021;2 PM;2\n", {"d", "from"},
                       "%d.%m.%Y %I %p"),
              two_hours);
}

TEST(TimeColumns, PartsAreKnownByTheirNamesInAnyOrder) {
    EXPECT_EQ(times_of("Day,Month,Year,HR,x\n5,3,2021,13,1\n5,3,2021,14,2\n",
                       {"Day", "Month", "Year", "HR"}),
              two_hours);
    EXPECT_EQ(times_of("YEAR,DOY,HR,x\n2021,64,13,1\n2021,64,14,2\n"), two_hours);
    EXPECT_EQ(
        times_of("Year,Month,Day,Hour,Minute,x\n2021,3,5,13,0,1\n2021,3,5,14,0,2\n"),
        two_hours);
}

TEST(TimeColumns, PartsThatNoNameTellsStandInTheirOrder) {
    EXPECT_EQ(times_of("a,b,c,d,x\n2021,3,5,13,1\n2021,3,5,14,2\n", {"a", "b", "c", "d"}),
              two_hours);
    EXPECT_THROW(times_of("a,b,c,x\n5,3,2021,1\n", {"a", "b", "c"}), UserError);
}

TEST(TimeColumns, AFormOfSeveralColumnsIsReadFromThemTogether) {
    EXPECT_EQ(times_of("h,d,m,y,x\n13,5,Mar,21,1\n14,5,Mar,21,2\n", {"d", "m", "y", "h"},
                       "%d %b %y %H"),
              two_hours);
}

TEST(TimeColumns, DatesMayBeginWithTheLastHourOfADay) {
    EXPECT_EQ(times_of("date,time,x\n2021-03-05 00:00:00,23:00,1\n"
                       "2021-03-06 00:00:00,00:00,2\n2021-03-06 00:00:00,01:00,3\n"),
              (Times{"2021-03-05 23:00", "2021-03-06 00:00", "2021-03-06 01:00"}));
}

TEST(TimeColumns, HoursFrom1To24AreTheEndsOfTheirHours) {
    EXPECT_EQ(times_of("date,hour,x\n2021-03-05,1,1\n2021-03-05,2,2\n2021-03-05,24,3\n",
                       {"date", "hour"}, "", false),
              (Times{"2021-03-05 00:00", "2021-03-05 01:00", "2021-03-05 23:00"}));
    EXPECT_EQ(times_of("Year,Month,Day,Hour,Minute,x\n2021,3,5,1,60,1\n2021,3,5,2,60,2\n"
                       "2021,3,5,24,60,3\n",
                       {}, "", false),
              (Times{"2021-03-05 00:00", "2021-03-05 01:00", "2021-03-05 23:00"}));
}

TEST(TimeColumns, ADateThatDoesNotRepeatHasNoClockBesideIt) {
    EXPECT_EQ(times_of("date,time,x\n2021-03-05,13:00,1\n2021-03-06,13:00,2\n"),
              (Times{"2021-03-05 00:00", "2021-03-06 00:00"}));
}

/// A day a line with columns that begin with `first` and count on.
std::string day_rows(const std::string& prefix, int first, int n) {
    std::string text = "date";
    for (int k = 0; k < n; ++k) text += "," + prefix + std::to_string(first + k);
    for (int d = 0; d < 2; ++d) {
        text += "\n2021-03-0" + std::to_string(5 + d);
        for (int k = 0; k < n; ++k) text += "," + std::to_string(100 * d + k);
    }
    return text + "\n";
}

RegularSeries unrolled_series(const std::string& text, const std::string& first) {
    const Csv csv = parse_csv(text, "x.csv");
    TimeColumns time;
    const auto rows = unrolled(csv, first, time, "", false);
    if (!rows) return {};
    return lay(*rows, stamps_in(*rows, time, {}), numbers_in(*rows, 1));
}

TEST(TimeColumns, ADayALineBecomesItsHoursAndHalfHours) {
    for (const int first : {0, 1}) {
        const RegularSeries hours =
            unrolled_series(day_rows("h", first, 24), "h" + std::to_string(first));
        EXPECT_EQ(hours.axis.step_s, 3600);
        EXPECT_EQ(format_time(hours.axis.start), "2021-03-05 00:00:00");
        ASSERT_EQ(hours.values.size(), 48U);
        EXPECT_EQ(hours.values[23], 23);
        EXPECT_EQ(hours.values[24], 100);
    }
    const RegularSeries halves = unrolled_series(day_rows("V", 1, 48), "V1");
    EXPECT_EQ(halves.axis.step_s, 1800);
    EXPECT_EQ(halves.values.size(), 96U);
}

TEST(TimeColumns, ADayOfColumnsMayBeNamedByTheClock) {
    std::string text = "Year,Month,Day";
    for (int k = 1; k <= 24; ++k)
        text += "," + std::to_string((k + 11) % 12 + 1) + ":00 " +
                (k / 12 == 1 ? "PM" : "AM");
    text += "\n2021,3,5";
    for (int k = 0; k < 24; ++k) text += "," + std::to_string(k);
    text += "\n";
    const Csv csv = parse_csv(text, "x.csv");
    TimeColumns time = time_columns(csv, {}, "");
    const auto rows = unrolled(csv, "1:00 AM", time, "", true);
    ASSERT_TRUE(rows);
    EXPECT_TRUE(time.by_ends);
    const Stamps stamps = stamps_in(*rows, time, {});
    EXPECT_EQ(format_time(stamps.begins[23]), "2021-03-05 23:00:00");
    EXPECT_EQ(numbers_in(*rows, 3)[23], 23);
}

TEST(TimeColumns, AColumnThatHoldsTimesIsNamedWhereTheFirstHoldsNone) {
    try {
        times_of("meter,when,x\n7,2021-03-05 13:00,1\n7,2021-03-05 14:00,2\n");
        FAIL() << "was read";
    } catch (const UserError& error) {
        EXPECT_NE(std::string(error.what()).find("set time = \"when\""),
                  std::string::npos)
            << error.what();
    }
}

TEST(TimeColumns, ADayOfColumnsNeedsNamesOfAWholeDayAndRowsOfDays) {
    EXPECT_TRUE(unrolled_series(day_rows("h", 0, 23), "h0").values.empty());
    EXPECT_TRUE(unrolled_series(day_rows("h", 0, 24), "h1").values.empty());
    EXPECT_TRUE(unrolled_series(day_rows("h", 2, 24), "h2").values.empty());
}

TEST(TimeColumns, ATwentyFifthHourIsRefused) {
    EXPECT_THROW(unrolled_series(day_rows("h", 1, 25), "h1"), UserError);
}

}  // namespace
}  // namespace bemcal::input
