#include "base/error.hpp"
#include "input/csv.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

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

TEST(Csv, TheSameColumnTwiceIsAnError) {
    EXPECT_THROW(input::parse_csv(std::string("a,a\n1,2\n"), "x.csv"), UserError);
}

}  // namespace
}  // namespace bemcal::job
