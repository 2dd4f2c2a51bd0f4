/// Tables of text: where the names and rows stand, what is no row, what is refused.
#include "base/error.hpp"
#include "input/csv_numbers.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

std::string complaint(const std::function<void()>& call) {
    try {
        call();
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::data);
        return error.what();
    }
    return "no complaint";
}

TEST(Csv, QuotedCellsKeepTheirSeparators) {
    const std::string text = "a,\"b, c\"\n1,\"2\"\n";
    const input::Csv csv = input::parse_csv(text, "x.csv");
    EXPECT_EQ(csv.columns, (std::vector<std::string>{"a", "b, c"}));
    EXPECT_EQ(input::number_in(csv, 0, 1), 2);
}

TEST(Csv, SemicolonsTabsByteOrderMarksAndCarriageReturnsAreRead) {
    const std::string semicolons = "\xEF\xBB\xBFtime;x\r\n# a comment\r\n\r\n1;2,5\r\n";
    const input::Csv csv = input::parse_csv(semicolons, "x.csv");
    EXPECT_EQ(csv.columns[0], "time");
    EXPECT_EQ(csv.lines[0], 4);
    EXPECT_EQ(input::number_in(csv, 0, 1, ','), 2.5);
    const std::string tabs = "a\tb\n1\t2\n";
    EXPECT_EQ(input::number_in(input::parse_csv(tabs, "x.csv"), 0, 1), 2);
}

TEST(Csv, EmptyCellsAndTheWordsForMissingAreNaN) {
    const std::string text = "a,b,c,d\n,NA,NaN,null\n";
    const input::Csv csv = input::parse_csv(text, "x.csv");
    for (std::size_t column = 0; column < 4; ++column)
        EXPECT_TRUE(std::isnan(input::number_in(csv, 0, column)));
}

TEST(Csv, NumbersThatAreNotFiniteOrHaveATailAreErrors) {
    const std::string text = "a\ninf\n1e999\n3 kWh\n0x10\n";
    const input::Csv csv = input::parse_csv(text, "x.csv");
    for (std::size_t row = 0; row < csv.n_rows(); ++row)
        EXPECT_THROW(input::number_in(csv, row, 0), UserError);
}

TEST(Csv, AColumnThatStandsTwiceIsAnErrorWhereItIsAskedFor) {
    const std::string text = "a,b,a\n1,2,3\n";
    const input::Csv csv = input::parse_csv(text, "x.csv");
    EXPECT_EQ(csv.column("b"), 1U);
    EXPECT_EQ(complaint([&] { csv.column("a"); }),
              "x.csv:1: column \"a\" stands there twice; rename one");
}

/// A meter's file: the column is asked for.
input::CsvForm asks_for(const std::vector<std::string>& names) {
    input::CsvForm form;
    form.names = names;
    return form;
}

/// The numbers of `kwh` and the lines that they stand in.
void expect_rows(const std::string& text, const std::vector<double>& numbers,
                 const std::vector<int>& lines, const std::vector<std::string>& notes,
                 const input::CsvForm& form = asks_for({"kwh"})) {
    const input::Csv csv = input::parse_csv(text, "x.csv", form);
    EXPECT_EQ(input::numbers_in(csv, csv.column("kwh")), numbers) << text;
    EXPECT_EQ(csv.lines, lines) << text;
    EXPECT_EQ(csv.notes, notes) << text;
}

TEST(CsvNames, StandInTheFirstLineThatHasThoseAskedFor) {
    expect_rows("Name,A B\nAddress,1 Street\n\ntime,kwh\n2021-01-01 00:00,5\n", {5}, {5},
                {"the names stand in line 4; 2 lines before it left out"});
    expect_rows(
        "Meter;Kind;From;To\n0001;load;01/01/2021;31/12/2021\ntime;kwh\n"
        "2021-01-01 00:00;5\n2021-01-01 01:00;6\n",
        {5, 6}, {4, 5}, {"the names stand in line 3; 2 lines before it left out"});
}

TEST(CsvNames, AreNotWhatNoNumbersStandBelow) {
    expect_rows(
        "Unit,kwh\nOwner,A B\nStreet,Long\nTown,Far\nLand,Away\nSort,load\n"
        "time,kwh\n2021-01-01 00:00,5\n",
        {5}, {8}, {"the names stand in line 7; 6 lines before it left out"});
}

TEST(CsvNames, MayStandBehindAHash) {
    expect_rows("# made\n#time,kwh\n2021-01-01 00:00,5\n", {5}, {3}, {});
    expect_rows("# time,kwh\n2021-01-01 00:00,5\n", {5}, {2}, {});
}

TEST(CsvNames, StandInTheLineThatTheJobSays) {
    input::CsvForm form = asks_for({"kwh"});
    form.header_line = 3;
    expect_rows("time,kwh\n2020-01-01 00:00,1\ntime,kwh\n2021-01-01 00:00,5\n", {5}, {4},
                {}, form);
    form.header_line = 9;
    EXPECT_EQ(
        complaint([&] {
            input::parse_csv(std::string("time,kwh\n2021-01-01,1\n"), "x.csv", form);
        }),
        "x.csv:9: header_line says that the names stand here, but the line is empty "
        "or not there");
}

TEST(CsvNames, ThatAreNowhereAreMissedInTheLineThatHasMost) {
    const std::string text = "Owner,A B\ntime,power,state\n2021-01-01 00:00,5,1\n";
    EXPECT_EQ(
        complaint([&] { input::parse_csv(text, "x.csv", asks_for({"time", "kwh"})); }),
        "x.csv:2: has no column \"kwh\"; it has time, power, state");
    EXPECT_EQ(complaint([&] { input::parse_csv(text, "x.csv", asks_for({"kwh"})); }),
              "x.csv:1: has no column \"kwh\"; it has Owner, A B; if the names stand in "
              "another line, set header_line");
}

TEST(CsvNames, MayHoldLineEndsAndQuotes) {
    const std::string text = "time;\"use\r\n[kWh]\";\"5\"\" pipe\"\r\n2021-01-01;5;6\r\n";
    const input::Csv csv = input::parse_csv(text, "x.csv", asks_for({"use\n[kWh]"}));
    EXPECT_EQ(csv.columns, (std::vector<std::string>{"time", "use\n[kWh]", "5\" pipe"}));
    EXPECT_EQ(csv.lines, std::vector<int>{3});
    EXPECT_EQ(input::number_in(csv, 0, 1), 5);
}

TEST(CsvLines, SepSaysTheSeparator) {
    expect_rows("sep=;\ntime;kwh\n2021-01-01 00:00;5\n", {5}, {3}, {});
    expect_rows("\"sep=|\"\ntime|kwh|a;b;c\n2021-01-01 00:00|5|x\n", {5}, {3}, {});
    const std::string text = "sep=;\na;b\n1;2\n";
    EXPECT_EQ(input::parse_csv(text, "x.csv").columns,
              (std::vector<std::string>{"a", "b"}));
}

TEST(CsvLines, UnitsBelowTheNamesAreLeftOut) {
    expect_rows("time,kwh\n-,kWh\n2021-01-01 00:00,5\n", {5}, {3},
                {"line 2 below the names left out: \"-,kWh\""});
    expect_rows("time,kwh\nyyyy-mm-dd,kWh/m2\n[UTC],mean\n2021-01-01 00:00,5\n", {5}, {4},
                {"line 2 below the names left out: \"yyyy-mm-dd,kWh/m2\"",
                 "line 3 below the names left out: \"[UTC],mean\""});
}

TEST(CsvLines, TotalsBehindTheLastRowAreLeftOut) {
    expect_rows("time,kwh\n2021-01-01 00:00,5\nTotal 2021,5\n,5\nMade by the portal\n",
                {5}, {2},
                {"3 lines behind the last row left out: line 3, \"Total 2021,5\""});
    expect_rows("time,kwh\nJan 1 2021,5\nJan 2 2021,6\nSum,11\n", {5, 6}, {2, 3},
                {"1 line behind the last row left out: line 4, \"Sum,11\""});
}

TEST(CsvLines, WithoutAStampBetweenRowsAreRows) {
    const std::string text =
        "time,kwh\n2021-01-01 00:00,5\nTotal January,5\n2021-02-01 00:00,6\n";
    EXPECT_EQ(input::parse_csv(text, "x.csv", asks_for({"kwh"})).n_rows(), 3U);
}

TEST(CsvLines, AreSkippedWhereTheJobSaysSo) {
    input::CsvForm form = asks_for({"kwh"});
    form.skip_lines = {2};
    form.skip_texts = {"Total"};
    expect_rows(
        "time,kwh\n2020-01-01 00:00,1\n2021-01-01 00:00,5\n\"Total January\",5\n"
        "2021-02-01 00:00,6\n",
        {5, 6}, {3, 5}, {"2 lines left out by skip, the first: line 2"}, form);
}

TEST(CsvLines, OfSeparatorsOnlyAndEmptyOnesAreNoRows) {
    const std::string text = "name;area\n\na;1\n;;\n \t\n\"\";\"\"\nb;2\n;\n";
    const input::Csv csv = input::parse_csv(text, "x.csv");
    EXPECT_EQ(csv.lines, (std::vector<int>{3, 7}));
}

TEST(CsvLines, ASeparatorMoreOrLessAtTheEndIsNoCell) {
    expect_rows("time,kwh\n2021-01-01 00:00,5,\n2021-01-01 01:00,6\n", {5, 6}, {2, 3},
                {});
    expect_rows("time,kwh,\n2021-01-01 00:00,5\n2021-01-01 01:00,6,\n", {5, 6}, {2, 3},
                {});
}

TEST(CsvLines, AStampAloneIsARowWithoutReadings) {
    const std::string text = "time,a,kwh\n2021-01-01 00:00\n2021-01-01 01:00,,\n";
    const input::Csv csv = input::parse_csv(text, "x.csv", asks_for({"kwh"}));
    ASSERT_EQ(csv.n_rows(), 2U);
    EXPECT_TRUE(std::isnan(input::number_in(csv, 0, 2)));
    EXPECT_TRUE(std::isnan(input::number_in(csv, 1, 2)));
}

TEST(CsvLines, OfAnotherWidthAreRefused) {
    const auto said = [](const std::string& text) {
        return complaint(
            [&] { input::parse_csv(text, "x.csv", asks_for({"kwh"})).column("kwh"); });
    };
    EXPECT_EQ(said("time,a,kwh\n2021-01-01 00:00,5\n"),
              "x.csv:2: has 2 cells; expected 3 as in the first line");
    EXPECT_EQ(
        said("time,kwh\n2021-01-01 00:00,5,25\n"),
        "x.csv:2: has 3 cells; expected 2 as in the first line; if commas are "
        "decimal marks, put such cells into quotes or separate cells by semicolons");
    EXPECT_EQ(
        said("a\n\ntime,kwh\n2021-01-01 00:00,5\nSum,1,2\n2021-01-01 01:00,5\n"),
        "x.csv:5: has 3 cells; expected 2 as in line 3; name lines that are no rows "
        "in skip, and the line of names in header_line");
}

TEST(CsvLines, MayEndWithACarriageReturnAlone) {
    expect_rows("time,kwh\r2021-01-01 00:00,5\r2021-01-01 01:00,6\r", {5, 6}, {2, 3}, {});
}

TEST(CsvLines, AQuoteThatStaysOpenIsALetter) {
    expect_rows("time,kwh,note\n2021-01-01 00:00,5,\"open\n2021-01-01 01:00,6,5\" pipe\n",
                {5, 6}, {2, 3}, {});
}

}  // namespace
}  // namespace bemcal::job
