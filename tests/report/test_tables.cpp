#include "report/tables.hpp"
#include "report/text_table.hpp"
#include "store/layout.hpp"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

namespace bemcal::report {
namespace {

using study::Dataset;

store::ResultFile sensitivity_result() {
    store::ResultFile result;
    const std::string g = "office/sa/";
    result.datasets = {
        {g + "output", {"output"}, {1}, {}, {"heating"}},
        {g + "output_unit", {"output"}, {1}, {}, {"kWh"}},
        {g + "parameter", {"parameter"}, {3}, {}, {"U_wall", "set_point", "lights"}},
        {g + "parameter_unit", {"parameter"}, {3}, {}, {"W/(m2 K)", "degC", "W/m2"}},
        {g + "parameter_least", {"parameter"}, {3}, {0.2, 19, 5}, {}},
        {g + "parameter_most", {"parameter"}, {3}, {2, 22, 12}, {}},
        {g + "total_order", {"output", "parameter"}, {1, 3}, {0.30, 0.68, 0.01}, {}},
        {g + "total_order_half_width",
         {"output", "parameter"},
         {1, 3},
         {0.03, 0.06, 0.001},
         {}},
        {g + "first_order", {"output", "parameter"}, {1, 3}, {0.28, 0.66, 0.0}, {}},
        {g + "first_order_half_width",
         {"output", "parameter"},
         {1, 3},
         {0.05, 0.07, 0.01},
         {}},
        {g + "threshold", {}, {}, {0.05}, {}},
        {g + "n_failed", {}, {}, {3}, {}},
        {g + "failed_reason",
         {"failure"},
         {3},
         {},
         {"reason one", "reason two", "reason one"}},
    };
    return result;
}

/// A meter read for two days by the hour; the best point is right, the nominal one 10 %
/// high.
store::ResultFile screening_result() {
    std::vector<double> time, measured, simulated;
    for (int hour = 0; hour < 48; ++hour) {
        time.push_back(3600.0 * hour);
        measured.push_back(10.0 + hour % 24);
    }
    measured[5] = std::nan("");
    for (int hour = 0; hour < 48; ++hour) simulated.push_back(1.1 * (10.0 + hour % 24));
    for (int hour = 0; hour < 48; ++hour) simulated.push_back(10.0 + hour % 24);
    store::ResultFile result;
    const std::string g = "office/screen/";
    result.datasets = {
        {g + "meter", {"meter"}, {1}, {}, {"gas"}},
        {g + "meter_unit", {"meter"}, {1}, {}, {"kWh"}},
        {g + "period", {"period"}, {1}, {}, {"training"}},
        {g + "resolution", {"resolution"}, {2}, {}, {"hourly", "monthly"}},
        {g + "guideline_14_count", {"period", "resolution"}, {1, 2}, {7, 5}, {}},
        {g + "n_points", {}, {}, {100}, {}},
        {g + "parameter", {"parameter"}, {1}, {}, {"U_wall"}},
        {g + "parameter_unit", {"parameter"}, {1}, {}, {"W/(m2 K)"}},
        {g + "parameter_least", {"parameter"}, {1}, {0.2}, {}},
        {g + "parameter_most", {"parameter"}, {1}, {2}, {}},
        {g + "candidate_parameters", {"candidate", "parameter"}, {2, 1}, {1.5, 0.75}, {}},
        {g + "training/gas/time", {"time"}, {48}, time, {}},
        {g + "training/gas/measured", {"time"}, {48}, measured, {}},
        {g + "training/gas/simulated", {"candidate", "time"}, {2, 48}, simulated, {}},
    };
    return result;
}

std::size_t widest_line(const std::string& text) {
    std::istringstream lines(text);
    std::size_t widest = 0;
    for (std::string line; std::getline(lines, line);)
        widest = std::max(widest, line.size());
    return widest;
}

TEST(Tables, ParametersStandByTotalOrderWithAMarkAboveTheThreshold) {
    const std::string text = tables_of(sensitivity_result());
    const auto first = text.find("set_point"), second = text.find("U_wall"),
               third = text.find("lights");
    ASSERT_NE(third, std::string::npos) << text;
    EXPECT_LT(first, second);
    EXPECT_LT(second, third);
    EXPECT_NE(text.find("0.680 +- 0.060"), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '*'), 3)
        << text;  // two rows and the heading
}

TEST(Tables, FailuresAreCountedByReason) {
    const std::string text = tables_of(sensitivity_result());
    EXPECT_NE(text.find("3 simulations failed"), std::string::npos) << text;
    EXPECT_NE(text.find("2 x reason one"), std::string::npos) << text;
}

TEST(Tables, FailuresThatDifferInTheirNumbersOnlyAreCountedTogether) {
    store::ResultFile result = sensitivity_result();
    for (Dataset& dataset : result.datasets)
        if (dataset.path.ends_with("failed_reason"))
            dataset.texts = {"H = 10.5 W/K", "H = 9e-3 W/K", "other"};
    const std::string text = tables_of(result);
    EXPECT_NE(text.find("2 x like: H = 10.5 W/K\n"), std::string::npos) << text;
    EXPECT_NE(text.find("1 x other\n"), std::string::npos) << text;
}

TEST(Tables, MetricsComeFromTheStoredSeries) {
    const std::string text = tables_of(screening_result());
    EXPECT_NE(text.find("10.0 ->   0.0"), std::string::npos)
        << text;  // NMBE, nominal and best
    EXPECT_NE(text.find("no -> yes"), std::string::npos) << text;  // monthly, 5 % NMBE
    EXPECT_NE(text.find("47"), std::string::npos) << "one reading is missing\n" << text;
    EXPECT_NE(text.find("7 of 100 points meet"), std::string::npos) << text;
    store::ResultFile changed = screening_result();
    for (Dataset& dataset : changed.datasets)
        if (store::leaf_of(dataset.path) == "measured")
            for (double& value : dataset.values) value *= 1.1;
    EXPECT_NE(tables_of(changed), text);
}

TEST(Tables, NoLineIsWiderThanAHundredColumns) {
    EXPECT_LE(widest_line(tables_of(sensitivity_result())), 100U);
    EXPECT_LE(widest_line(tables_of(screening_result())), 100U);
}

TEST(Tables, AResultWithoutStudiesGivesNoText) {
    EXPECT_EQ(tables_of({}), "");
}

TEST(Status, SaysWhenTheContentIsNotWhatTheHashSays) {
    store::ResultFile result = sensitivity_result();
    result.complete = true;
    result.hash = store::result_hash(result);
    EXPECT_EQ(status_of(result).find("DAMAGED"), std::string::npos);
    result.datasets[6].values[0] = 0.31;
    EXPECT_NE(status_of(result).find("DAMAGED"), std::string::npos);
}

TEST(TextTable, NumbersStandToTheRightAndWordsToTheLeft) {
    TextTable table({"name", "value"});
    table.add({"a", "1.5"});
    table.add({"bcd", "12.25"});
    EXPECT_EQ(table.text(), "  name  value\n  a       1.5\n  bcd   12.25\n");
}

TEST(TextTable, ColumnsAreAlignedByCharactersNotBytes) {
    TextTable table({"name", "x"});
    table.add({"m\xc3\xbcller", "1"});
    table.add({"miller", "1"});
    const std::string text = table.text();
    EXPECT_NE(text.find("m\xc3\xbcller  1\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace bemcal::report
