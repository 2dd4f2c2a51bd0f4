#include "base/error.hpp"
#include "input/bills.hpp"
#include "input/csv_numbers.hpp"
#include "physics/calendar.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::input {
namespace {

using physics::format_date;
using physics::Interval;

/// "2021-01-12 2021-02-12 40; ..." with "-" for a missing value.
std::string words_of(const std::vector<Bill>& bills) {
    std::string text;
    for (const Bill& bill : bills)
        text += format_date(bill.from) + " " + format_date(bill.to) + " " +
                (std::isnan(bill.value)
                     ? std::string("-")
                     : std::to_string(static_cast<int>(std::lround(bill.value)))) +
                "; ";
    return text;
}

struct Read {
    std::string bills;
    std::vector<TimeNote> notes;
};

/// The bills of the column x; times stand in `from`, or in the first column.
Read read(const std::string& text, const BillColumns& columns = {},
          StampRules rules = {}) {
    const Csv csv = parse_csv(text, "x.csv");
    if (!columns.from.empty() || !columns.to.empty()) rules.is_said = true;
    rules.at_end = rules.at_end || (columns.from.empty() && !columns.to.empty());
    const std::string& time = columns.from.empty() ? columns.to : columns.from;
    const Stamps stamps =
        stamps_in(csv, time.empty() ? 0 : csv.column(time), rules, 31 * 86400);
    Read found;
    found.bills =
        words_of(bills_in(csv, columns, stamps, rules, numbers_in(csv, csv.column("x")),
                          Interval::monthly, false, found.notes));
    return found;
}

StampRules unsaid() {
    StampRules rules;
    rules.is_said = false;
    return rules;
}

// A quarter is no month with two months missing behind it.
TEST(Bills, OfQuartersLastUntilTheNext) {
    const Read quarters = read(
        "t,x\n2021-01-01,1\n2021-04-01,2\n2021-07-01,3\n2021-10-01,4\n", {}, unsaid());
    EXPECT_EQ(
        quarters.bills,
        "2021-01-01 2021-04-01 1; 2021-04-01 2021-07-01 2; 2021-07-01 2021-10-01 3; ");
    EXPECT_EQ(quarters.notes.at(0).finding, "its rows begin 3 months apart");
    EXPECT_EQ(read("t,x\n2021-01-01,1\n2021-04-01,2\n2021-07-01,3\n", {}, unsaid())
                  .bills.substr(0, 22),
              "2021-01-01 2021-04-01 ")
        << "three rows are the fewest";
    EXPECT_EQ(read("t,x\n2021-01-01,1\n2021-04-01,2\n2021-07-01,3\n").bills.substr(0, 22),
              "2021-01-01 2021-02-01 ")
        << "stamp = start";
}

TEST(Bills, OfQuartersThatAreStampedByTheirLastDayAreWhole) {
    StampRules ends;
    ends.at_end = true;
    const Read quarters =
        read("t,x\n2021-03-31,1\n2021-06-30,2\n2021-09-30,3\n", {}, ends);
    EXPECT_EQ(
        quarters.bills,
        "2021-01-01 2021-04-01 1; 2021-04-01 2021-07-01 2; 2021-07-01 2021-10-01 3; ");
    EXPECT_EQ(quarters.notes.at(0).finding, "its rows end 3 months apart");
}

TEST(Bills, OfMonthsWithGapsAreOfMonths) {
    for (const char* months :
         {"2021-01-01,1\n2021-02-01,2\n2021-05-01,3\n", "2021-01-01,1\n2021-03-01,2\n",
          "2021-01-01,1\n2021-03-01,2\n2021-06-01,3\n"})
        EXPECT_EQ(read(std::string("t,x\n") + months, {}, unsaid()).bills.substr(0, 22),
                  "2021-01-01 2021-02-01 ");
}

TEST(Bills, OfCalendarMonthsAreTheMonths) {
    EXPECT_EQ(read("t,x\n2021-01-01,1\n2021-02-01,2\n").bills,
              "2021-01-01 2021-02-01 1; 2021-02-01 2021-03-01 2; ");
    StampRules ends;
    ends.at_end = true;
    EXPECT_EQ(read("t,x\n2021-01-31,1\n2021-02-28,2\n", {}, ends).bills,
              "2021-01-01 2021-02-01 1; 2021-02-01 2021-03-01 2; ");
    EXPECT_EQ(read("t,x\n2021-02-01,1\n2021-03-01,2\n", {}, ends).bills,
              "2021-01-01 2021-02-01 1; 2021-02-01 2021-03-01 2; ");
}

TEST(Bills, LastDaysOfMonthsAreEndsUnlessSomebodySaysOtherwise) {
    const char* text = "t,x\n2021-01-31,1\n2021-02-28,2\n2021-03-31,3\n";
    const Read ends = read(text, {}, unsaid());
    EXPECT_EQ(ends.bills,
              "2021-01-01 2021-02-01 1; 2021-02-01 2021-03-01 2; "
              "2021-03-01 2021-04-01 3; ");
    ASSERT_EQ(ends.notes.size(), 1U);
    EXPECT_EQ(ends.notes[0].finding, "its stamps are the last days of months");
    EXPECT_EQ(read(text).bills,
              "2021-01-31 2021-02-28 1; 2021-02-28 2021-03-31 2; "
              "2021-03-31 2021-04-30 3; ");
}

TEST(Bills, OfOneDayOfTheMonthEndOnThatDay) {
    const char* text = "t,x\n2021-01-12,1\n2021-02-12,2\n2021-03-12,3\n";
    EXPECT_EQ(read(text).bills,
              "2021-01-12 2021-02-12 1; 2021-02-12 2021-03-12 2; "
              "2021-03-12 2021-04-12 3; ");
    StampRules ends;
    ends.at_end = true;
    EXPECT_EQ(read(text, {}, ends).bills,
              "2020-12-12 2021-01-12 1; 2021-01-12 2021-02-12 2; "
              "2021-02-12 2021-03-12 3; ");
}

TEST(Bills, BetweenReadDatesLeaveOutWhatNobodyCanKnow) {
    const char* text = "t,x\n2021-01-04,1\n2021-02-03,2\n2021-03-05,3\n";
    const Read starts = read(text);
    EXPECT_EQ(starts.bills, "2021-01-04 2021-02-03 1; 2021-02-03 2021-03-05 2; ");
    ASSERT_EQ(starts.notes.size(), 1U);
    EXPECT_EQ(starts.notes[0].finding, "when its last bill ends is not in the file");
    StampRules ends;
    ends.at_end = true;
    EXPECT_EQ(read(text, {}, ends).bills,
              "2021-01-04 2021-02-03 2; 2021-02-03 2021-03-05 3; ");
    // A last row without a reading is the end of the one before it.
    EXPECT_TRUE(read("t,x\n2021-01-04,1\n2021-02-03,2\n2021-03-05,\n").notes.empty());
}

TEST(Bills, WithFromAndToAreEachOnItsOwn) {
    const BillColumns columns{"from", "to", ""};
    EXPECT_EQ(
        read("from,to,x\n2021-01-04,2021-02-03,1\n2021-02-03,2021-04-05,2\n", columns)
            .bills,
        "2021-01-04 2021-02-03 1; 2021-02-03 2021-04-05 2; ");
    const Read days =
        read("from,to,x\n2021-01-04,2021-02-02,1\n2021-02-03,2021-04-04,2\n", columns);
    EXPECT_EQ(days.bills, "2021-01-04 2021-02-03 1; 2021-02-03 2021-04-05 2; ");
    EXPECT_EQ(days.notes.size(), 1U);
    const Read one = read("from,to,x\n2021-01-01,2021-01-31,1\n", columns);
    EXPECT_EQ(one.bills, "2021-01-01 2021-02-01 1; ");
}

TEST(Bills, ASecondColumnOfLaterTimesHoldsTheirEnds) {
    const Read found = read(
        "start,end,x\n2021-01-04,2021-02-02,1\n2021-02-03,2021-04-04,2\n", {}, unsaid());
    EXPECT_EQ(found.bills, "2021-01-04 2021-02-03 1; 2021-02-03 2021-04-05 2; ");
    ASSERT_EQ(found.notes.size(), 2U);
    EXPECT_EQ(found.notes[0].finding, "its column end holds the ends of its bills");
}

TEST(Bills, GapsAreToldAndOverlapsRefused) {
    const BillColumns columns{"from", "to", ""};
    const std::string first =
        "from,to,x\n2021-01-04,2021-02-03,1\n2021-02-03,2021-03-05,2\n";
    const std::string text = first + "2021-04-03,2021-05-05,3\n";
    const Csv csv = parse_csv(text, "x.csv");
    std::vector<TimeNote> notes;
    const Stamps from = stamps_in(csv, 0, {}), to = stamps_in(csv, 1, {});
    const auto bills = bills_from_to(csv, from, to, numbers_in(csv, 2), notes);
    const RegularSeries hours = series_of(bills, notes);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].finding,
              "1 gap between its bills; the first: 2021-03-05 to 2021-04-03");
    EXPECT_EQ(bounds_of(bills).size(), 5U);
    EXPECT_EQ(hours.values[30 * 24], 2);  // at its first hour
    EXPECT_THROW(read(first + "2021-03-01,2021-04-03,3\n", columns), UserError);
    EXPECT_THROW(
        read("from,to,x\n2021-01-04,2021-01-04,1\n2021-02-03,2021-02-03,2\n", columns),
        UserError);
}

TEST(Bills, EstimatedReadsAreMergedWithTheNextThatWasRead) {
    const Read found = read(
        "t,x,how\n2021-01-01,10,A\n2021-02-01,20,E\n2021-03-01,30,estimated\n"
        "2021-04-01,-4,actual\n2021-05-01,6,A\n2021-06-01,7,E\n",
        {"", "", "how"});
    EXPECT_EQ(found.bills,
              "2021-01-01 2021-02-01 10; 2021-02-01 2021-05-01 46; "
              "2021-05-01 2021-06-01 6; 2021-06-01 2021-07-01 -; ");
    ASSERT_EQ(found.notes.size(), 2U);
    EXPECT_EQ(found.notes[0].finding, "2 reads are estimated");
    EXPECT_EQ(found.notes[1].finding,
              "1 estimated read is followed by none that was read");
    EXPECT_THROW(read("t,x,how\n2021-01-01,10,perhaps\n", {"", "", "how"}), UserError);
}

// The first of a month there is the last of the month before at the site.
TEST(Bills, OfTheCalendarByAClockAheadOfTheSiteAreKnown) {
    const std::string text = "t,x\n2021-01-01,1\n2021-02-01,2\n2021-03-01,3\n";
    const Csv csv = parse_csv(text, "x.csv");
    for (const double ahead : {-9.0, 1.0, 8.0}) {
        StampRules rules;
        rules.file_offset_h = ahead;
        rules.is_said = false;
        std::vector<TimeNote> notes;
        const auto bills = bills_by_calendar(stamps_in(csv, 0, rules), {1, 2, 3},
                                             Interval::monthly, false, notes);
        ASSERT_TRUE(bills) << ahead;
        EXPECT_EQ(bills->front().from, physics::parse_time("2021-01-01"));
        EXPECT_EQ(bills->back().to, physics::parse_time("2021-04-01"));
        EXPECT_TRUE(notes.empty());
    }
}

TEST(Bills, OfTheCalendarAreKnown) {
    std::vector<TimeNote> notes;
    const std::string text = "t,x\n2021-01-01,1\n2021-02-01,2\n";
    const Csv csv = parse_csv(text, "x.csv");
    const auto bills =
        bills_by_calendar(stamps_in(csv, 0, {}), {1, 2}, Interval::monthly, true, notes);
    ASSERT_TRUE(bills);
    EXPECT_TRUE(are_of_calendar(*bills, Interval::monthly));
    EXPECT_FALSE(are_of_calendar(*bills, Interval::annual));
}

}  // namespace
}  // namespace bemcal::input
