/// Numbers in cells: marks between thousands, decimal marks, words for missing.
#include "base/error.hpp"
#include "input/csv_numbers.hpp"
#include "input/input_files.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using Cells = std::vector<std::string>;

/// A section that says nothing of its numbers.
input::NumberForm unsaid() {
    input::NumberForm form;
    form.decimal_is_said = false;
    form.thousands = "";
    return form;
}

input::NumberForm said(char decimal, const std::string& thousands = "") {
    input::NumberForm form(decimal);
    form.thousands = thousands;
    return form;
}

std::string column_of(const Cells& cells) {
    std::string text = "time;x\n";
    for (const std::string& cell : cells) text += "t;" + cell + "\n";
    return text;
}

std::vector<double> numbers(const Cells& cells, const input::NumberForm& form) {
    const std::string text = column_of(cells);
    return input::numbers_in(input::parse_csv(text, "x.csv"), 1, form);
}

std::string complaint(const Cells& cells, const input::NumberForm& form) {
    try {
        numbers(cells, form);
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::data);
        return error.what();
    }
    return "no complaint";
}

using Numbers = std::vector<double>;

TEST(Thousands, AreReadByTheirMark) {
    EXPECT_EQ(numbers({"1,234.5", "-12,345,678", "999", "1234.5"}, said('.', ",")),
              (Numbers{1234.5, -12345678, 999, 1234.5}));
    EXPECT_EQ(numbers({"1.234,5", "1.234", "0,5"}, said(',', ".")),
              (Numbers{1234.5, 1234, 0.5}));
    EXPECT_EQ(numbers({"1 234,5",
                       "1\xC2\xA0"
                       "234",
                       "1\xE2\x80\xAF"
                       "234,25"},
                      said(',', " ")),
              (Numbers{1234.5, 1234, 1234.25}));
    EXPECT_EQ(numbers({"1'234.5",
                       "1\xE2\x80\x99"
                       "234"},
                      said('.', "'")),
              (Numbers{1234.5, 1234}));
}

TEST(Thousands, OfOtherThanThreeDigitsAreNone) {
    for (const char* cell :
         {"1,23", "1,2345", "0,123", "12,34,567", "1,234,5", "1234,567"})
        EXPECT_EQ(
            complaint({cell}, said('.', ",")),
            fmt::format("x.csv:2:x: \"{}\" is not a number; expected groups of three "
                        "digits between \",\", and \".\" as decimal mark",
                        cell));
}

TEST(Thousands, ThatAreNotSaidAreAskedFor) {
    EXPECT_EQ(complaint({"12.5", "1,234"}, unsaid()),
              "x.csv:3:x: \"1,234\" may be 1234 or 1.234; set thousands = \",\" if it is "
              "the first, thousands = \"none\" and decimal = \",\" if it is the second");
    EXPECT_EQ(complaint({"1.234"}, said(',')),
              "x.csv:2:x: \"1.234\" may be 1234 or 1.234; set thousands = \".\" if it is "
              "the first, thousands = \"none\" and decimal = \".\" if it is the second");
    EXPECT_EQ(complaint({"1,234.5"}, unsaid()),
              "x.csv:2:x: \"1,234.5\" has a mark between its thousands; set thousands = "
              "\",\"");
    EXPECT_EQ(complaint({"1.234,5"}, unsaid()),
              "x.csv:2:x: \"1.234,5\" has a mark between its thousands; set thousands = "
              "\".\" and decimal = \",\"");
    EXPECT_EQ(
        complaint({"1.234.567"}, unsaid()),
        "x.csv:2:x: \"1.234.567\" has a mark between its thousands; set thousands = "
        "\".\" and decimal = \",\"");
    EXPECT_EQ(
        complaint({"1 234"}, unsaid()),
        "x.csv:2:x: \"1 234\" has a mark between its thousands; set thousands = \" \"");
}

/// 361 and 1.798 in one column: a fraction would have fewer digits now and then.
TEST(Thousands, MayBeWhatLooksLikeADecimalMark) {
    const Cells mixed{"361", "1.798", "950", "1.204", "480"};
    EXPECT_EQ(
        complaint(mixed, unsaid()),
        "x.csv:3:x: \"1.798\" may be 1798 or 1.798; set thousands = \".\" and decimal "
        "= \",\" if it is the first, thousands = \"none\" if it is the second");
    EXPECT_EQ(numbers(mixed, said(',', ".")), (Numbers{361, 1798, 950, 1204, 480}));
    EXPECT_EQ(numbers(mixed, said('.', "none")), (Numbers{361, 1.798, 950, 1.204, 480}));
    const Cells commas{"361", "1,798", "950", "1,204", "480"};
    EXPECT_EQ(
        complaint(commas, said(',')),
        "x.csv:3:x: \"1,798\" may be 1798 or 1.798; set thousands = \",\" and decimal "
        "= \".\" if it is the first, thousands = \"none\" if it is the second");
}

TEST(Thousands, AreAskedForInAFewReadingsOfThreeDecimals) {
    const Cells few{"1.234", "2.345", "5.678"};
    EXPECT_NE(complaint(few, unsaid()).find("may be 1234 or 1.234"), std::string::npos);
    EXPECT_EQ(numbers(few, said('.')), (Numbers{1.234, 2.345, 5.678}));
    EXPECT_EQ(numbers(few, said(',', ".")), (Numbers{1234, 2345, 5678}));
}

TEST(Thousands, AreNotAskedForWhereACellTellsOfTheMark) {
    EXPECT_EQ(numbers({"0.125", "12.345", "7"}, unsaid()), (Numbers{0.125, 12.345, 7}));
    EXPECT_EQ(numbers({"12.345", "12.5"}, unsaid()), (Numbers{12.345, 12.5}));
    EXPECT_EQ(numbers({"1.234", "1234.567"}, unsaid()), (Numbers{1.234, 1234.567}));
    EXPECT_EQ(numbers({"1.234", "5678", "6789"}, unsaid()), (Numbers{1.234, 5678, 6789}));
    EXPECT_EQ(numbers({"12,345", "0,5"}, said(',')), (Numbers{12.345, 0.5}));
}

/// A logger's %.3f over months: three decimals everywhere, 0 and a code without a mark.
TEST(Thousands, AreNotAskedForInManyReadingsOfThreeDecimals) {
    Cells cells;
    for (int k = 0; k < 60; ++k) cells.push_back(fmt::format("{:.3f}", 4 + k / 7.0));
    EXPECT_EQ(numbers(cells, unsaid())[0], 4);
    cells.insert(cells.end(), {"0", "0", "-999", "-999"});
    EXPECT_EQ(numbers(cells, unsaid()).size(), 64U);
    input::NumberForm form = unsaid();
    form.missing_numbers = {-999};
    EXPECT_TRUE(std::isnan(numbers(cells, form)[63]));
}

TEST(Numbers, OfTheDecimalCommaStandBesideThoseOfThePoint) {
    EXPECT_EQ(numbers({"12,5", "12.5", "-0,25", "+3"}, said(',')),
              (Numbers{12.5, 12.5, -0.25, 3}));
}

TEST(Numbers, HaveBlanksAndTheSignOfPrint) {
    EXPECT_EQ(numbers({"\" 12.5 \"",
                       "\xC2\xA0"
                       "7",
                       "\xE2\x88\x92"
                       "3.5"},
                      unsaid()),
              (Numbers{12.5, 7, -3.5}));
}

TEST(Missing, IsWhatSpreadsheetsLoggersAndPandasWrite) {
    for (const char* word :
         {"",        "NA",      "N/A",  "NaN",  "nan",     "-nan",    "null",   "NULL",
          "None",    "none",    "-",    "--",   "missing", "Missing", "#N/A",   "#NV",
          "#DIV/0!", "#VALUE!", "<NA>", "n.a.", "k.A.",    "No Data", "-1.#IND"})
        EXPECT_TRUE(input::is_missing(word)) << word;
    for (const char* word : {"0", "-0", "-5", "x", "inf", "nano", "1e-3"})
        EXPECT_FALSE(input::is_missing(word)) << word;
}

TEST(Missing, IsWhatTheJobSays) {
    input::NumberForm form = unsaid();
    form.missing = {"Bad Input"};
    form.missing_numbers = {-999, 9999};
    const Numbers found = numbers({"1.5", "Bad Input", "-999.0", "9999", "2"}, form);
    EXPECT_EQ(found[0], 1.5);
    for (const std::size_t k : {1U, 2U, 3U}) EXPECT_TRUE(std::isnan(found[k]));
    EXPECT_EQ(found[4], 2);
    EXPECT_EQ(
        complaint({"Bad Input"}, unsaid()),
        "x.csv:2:x: \"Bad Input\" is not a number; leave the cell empty where a value "
        "is missing, or set missing = [\"Bad Input\"]");
}

/// Columns of numbers of a real file, but for its stamps.
std::vector<Numbers> real_columns(const input::Csv& csv, const input::NumberForm& form) {
    std::vector<Numbers> columns;
    for (std::size_t c = 1; c < csv.columns.size(); ++c)
        columns.push_back(input::numbers_in(csv, c, form));
    return columns;
}

/// The same file with dots between thousands and decimal commas, cells between
/// semicolons.
std::string in_german(std::string text) {
    std::string made;
    for (const char c : text) made += c == ',' ? ';' : c == '.' ? ',' : c;
    for (std::size_t end = 0; (end = made.find_first_of(",;\n", end + 1)) != made.npos;) {
        std::size_t begin = end;
        while (begin > 0 && std::isdigit(static_cast<unsigned char>(made[begin - 1])))
            --begin;
        const bool is_whole =
            begin > 0 && (made[begin - 1] == ';' || made[begin - 1] == '-');
        for (; is_whole && end > begin + 3 && made[begin - 1] != ','; end -= 3)
            made.insert(end - 3, 1, '.');
        end = made.find_first_of(",;\n", end);
    }
    return made;
}

bool same(const std::vector<Numbers>& one, const std::vector<Numbers>& other) {
    const auto alike = [](double a, double b) {
        return a == b || (std::isnan(a) && std::isnan(b));
    };
    return std::ranges::equal(one, other, [&](const Numbers& a, const Numbers& b) {
        return std::ranges::equal(a, b, alike);
    });
}

TEST(RealMeters, HaveTheSameNumbersWithoutAQuestionAndInGerman) {
    for (const char* name :
         {"meters/cambridge_gas.csv.gz", "meters/hong_kong_cooling.csv.gz",
          "meters/orlando_hannah.csv.gz", "meters/tartu_bPr01_heat.csv.gz",
          "data/building_1298/hourly.csv.gz", "data/uk_home/gas.csv.gz"}) {
        const auto path = std::filesystem::path(BEMCAL_ROOT) / "../shared" / name;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << path;
        input::InputFiles files;
        const auto plain = real_columns(files.csv(path), said('.', "none"));
        EXPECT_TRUE(same(real_columns(files.csv(path), unsaid()), plain)) << name;
        const std::string german = in_german(files.text(path));
        EXPECT_TRUE(
            same(real_columns(input::parse_csv(german, "x.csv"), said(',', ".")), plain))
            << name;
    }
}

}  // namespace
}  // namespace bemcal::job
