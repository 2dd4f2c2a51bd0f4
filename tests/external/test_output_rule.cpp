#include "external/folder.hpp"
#include "external/output_rule.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bemcal::external {
namespace {

Reading read(const std::string& text, const OutputRule& rule) {
    const Folder folder;
    folder.write(rule.file, text);
    return WrittenFiles(folder.path()).read(rule);
}

OutputRule column(const std::string& name, Take take = Take::only) {
    OutputRule rule;
    rule.file = "out.csv";
    rule.column = name;
    rule.take = take;
    return rule;
}

OutputRule pattern(const std::string& text, Take take = Take::only) {
    OutputRule rule;
    rule.file = "log";
    rule.pattern = text;
    rule.take = take;
    return rule;
}

constexpr const char* table =
    "Date/Time,Gas [J](Hourly) ,T [C]\n"
    " 01/01 01:00,3.6e6,20\n 01/01 02:00, 7.2e6,\n"
    " 01/01 03:00,,21.5\n";

TEST(OutputRule, ReducesAColumn) {
    OutputRule gas = column("Gas [J](Hourly)", Take::sum);
    gas.factor = 1 / 3.6e6;
    EXPECT_DOUBLE_EQ(read(table, gas).value, 3);
    EXPECT_EQ(read(table, column("T [C]", Take::mean)).value, 20.75);
    EXPECT_EQ(read(table, column("T [C]", Take::first)).value, 20);
    EXPECT_EQ(read(table, column("T [C]", Take::last)).value, 21.5);
    EXPECT_EQ(read(table, column("T [C]", Take::least)).value, 20);
    EXPECT_EQ(read(table, column("T [C]", Take::most)).value, 21.5);
}

TEST(OutputRule, TakesARow) {
    OutputRule rule = column("Gas [J](Hourly)", Take::row);
    rule.row = 2;
    rule.offset = 1;
    EXPECT_EQ(read(table, rule).value, 7.2e6 + 1);
    rule.row = 3;
    EXPECT_EQ(read(table, rule).failure,
              "out.csv: the column \"Gas [J](Hourly)\" has 2 numbers, but row = 3");
}

TEST(OutputRule, FailsWithMoreOrFewerNumbersThanAskedFor) {
    OutputRule rule = column("Gas [J](Hourly)", Take::sum);
    rule.rows = 2;
    EXPECT_EQ(read(table, rule).failure, "");
    for (const int rows : {1, 3}) {
        rule.rows = rows;
        EXPECT_EQ(
            read(table, rule).failure,
            fmt::format("out.csv: the column \"Gas [J](Hourly)\" has 2 numbers, but "
                        "rows = {}",
                        rows));
    }
}

TEST(OutputRule, ReadsWhatOtherProgramsSeparateBy) {
    EXPECT_EQ(read("a;b\n1;2\n", column("b")).value, 2);
    EXPECT_EQ(read("a\tb\r\n1\t2\r\n", column("b")).value, 2);
    EXPECT_EQ(read("  TIME   Qheat \n  1.0   +2.50E+01  \n", column("Qheat")).value, 25);
    EXPECT_EQ(read("\"a, b\",\"c\"\n1,\"2\"\n", column("a, b")).value, 1);
    OutputRule printer = column("Q");
    printer.header_line = 2;
    printer.skipped = 1;
    EXPECT_EQ(read("Type 25\nTIME Q\nh kWh\n1 7\n", printer).value, 7);
}

TEST(OutputRule, ANumberThatIsNoneIsToldWhereverItStands) {
    for (const Take take : {Take::least, Take::most, Take::sum, Take::mean})
        EXPECT_EQ(read("a\n1\nnan\n3\n", column("a", take)).failure,
                  "out.csv: the column \"a\" has nan, not a finite number");
}

TEST(OutputRule, AByteOrderMarkIsNoPartOfAName) {
    EXPECT_EQ(read("\xEF\xBB\xBFgas,b\n1,2\n", column("gas")).value, 1);
}

TEST(OutputRule, AnOnlyColumnsNameMayHoldBlanks) {
    EXPECT_EQ(read("gas [kWh]\n1\n2\n", column("gas [kWh]", Take::sum)).value, 3);
}

TEST(OutputRule, OfTwoColumnsOfOneNameNoneIsTaken) {
    EXPECT_EQ(read("a,b,a\n1,2,3\n", column("a")).failure,
              "out.csv: has several columns \"a\"");
}

TEST(OutputRule, WhatIsNotThereHasAReason) {
    EXPECT_EQ(read(table, column("heat")).failure,
              "out.csv: has no column \"heat\", but Date/Time, Gas [J](Hourly), T [C]");
    EXPECT_EQ(read(table, column("T [C]")).failure,
              "out.csv: the column \"T [C]\" has 2 numbers, not one: say which to take");
    EXPECT_EQ(read("a\n", column("a")).failure,
              "out.csv: the column \"a\" has no number");
    EXPECT_EQ(read("", column("a")).failure,
              "out.csv: has no line 1 with the names of columns");
    EXPECT_EQ(read("a,b\n1,2\n3,x1\n", column("b", Take::sum)).failure,
              "out.csv: line 3 of the column \"b\": \"x1\" is no number");
    EXPECT_EQ(read("a\nnan\n", column("a")).failure,
              "out.csv: the column \"a\" has nan, not a finite number");
    WrittenFiles absent("/nonexistent");
    EXPECT_EQ(absent.read(column("a")).failure, "out.csv: it has not been written");
}

TEST(OutputRule, AFileAboveItsLimitIsNotRead) {
    const Folder folder;
    folder.write("out.csv", "a\n1\n");
    EXPECT_EQ(WrittenFiles(folder.path(), 4).read(column("a")).value, 1);
    EXPECT_EQ(WrittenFiles(folder.path(), 3).read(column("a")).failure,
              "out.csv: is larger than its limit: 4 bytes, but output_limit = 3e-06 MB");
}

TEST(OutputRule, APatternFindsNumbersInAnyText) {
    const char* text = "step 1 heat= 5 kWh\nstep 2 heat= 7.5 kWh\r\ndone\n";
    EXPECT_EQ(read(text, pattern("heat= *([0-9.]+)", Take::sum)).value, 12.5);
    EXPECT_EQ(read(text, pattern("^step (2)")).value, 2);
    EXPECT_EQ(read(text, pattern("([0-9.]+) kWh$", Take::last)).value, 7.5);
    EXPECT_EQ(read("1,2,3", pattern("([0-9])", Take::mean)).value, 2);
}

TEST(OutputRule, APatternThatFindsNothingHasAReason) {
    EXPECT_EQ(read("done\n", pattern("heat= ([0-9]+)")).failure,
              "log: \"heat= ([0-9]+)\" finds no number");
    EXPECT_EQ(read("heat= x\n", pattern("heat= (.*)")).failure,
              "log: \"heat= (.*)\" finds \"x\", which is no number");
    EXPECT_EQ(read("1 2", pattern("([0-9])")).failure,
              "log: \"([0-9])\" finds 2 numbers, not one: say which to take");
}

TEST(OutputRule, ALongLineIsNoDanger) {
    const std::string text(8000, 'x');
    EXPECT_FALSE(read(text, pattern("(x*)y")).failure.empty());
    EXPECT_EQ(read(text + "\nheat 3\n", pattern("heat ([0-9])")).value, 3);
}

TEST(OutputRule, RefusesPatternsThatCannotWork) {
    EXPECT_NO_THROW(check_pattern("heat ([0-9]+)"));
    EXPECT_THROW(check_pattern("heat [0-9]+"), std::invalid_argument);
    EXPECT_THROW(check_pattern("heat ([0-9]+"), std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::external
