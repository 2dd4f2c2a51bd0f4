#include "report/text_table.hpp"

#include <gtest/gtest.h>

namespace bemcal::report {
namespace {

TEST(TextTable, CutsCellsThatAreTooWide) {
    EXPECT_EQ(cut("infiltration", 12), "infiltration");
    EXPECT_EQ(cut("infiltration", 11), "infiltrat..");
}

TEST(TextTable, CutsBetweenCharactersNotWithinOne) {
    EXPECT_EQ(cut("W\u00e4rmed\u00e4mmung", 12), "W\u00e4rmed\u00e4mmung");
    EXPECT_EQ(cut("W\u00e4rmed\u00e4mmung", 10), "W\u00e4rmed\u00e4m..");
    EXPECT_EQ(cut("\u0442\u0435\u043f\u043b\u043e", 4), "\u0442\u0435..");
}

TEST(TextTable, AlignsByCharacters) {
    TextTable table({"name", "n"});
    table.add({"K\u00e4lte", "1"});
    table.add({"W\u00e4rme und Licht", "20"});
    EXPECT_EQ(table.text(8),
              "  name       n\n  K\u00e4lte      1\n  W\u00e4rme ..  20\n");
}

TEST(TextTable, AFindingIsSaidToItsEnd) {
    const std::string advice(120, 'x');
    const std::string line = finding_line("weather", "late", "kept; " + advice);
    EXPECT_TRUE(line.starts_with("  weather: late: kept;"));
    EXPECT_NE(line.find(advice), std::string::npos);
}

TEST(TextTable, CellsThatOnlyTheirEndsTellApartKeepThem) {
    TextTable table({"unknown"});
    table.add({"electricity_constant of east"});
    table.add({"electricity_constant of west"});
    table.add({"infiltration"});
    EXPECT_EQ(table.text(16),
              "  unknown\n  electri..of east\n  electri..of west\n  infiltration\n");
    TextTable other({"unknown"});
    other.add({"electricity_constant of east"});
    other.add({"infiltration"});
    EXPECT_EQ(other.text(16), "  unknown\n  electricity_co..\n  infiltration\n");
}

}  // namespace
}  // namespace bemcal::report
