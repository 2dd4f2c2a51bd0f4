#include "base/random.hpp"
#include "report/merge_chains.hpp"
#include "report/tables.hpp"
#include "report/text_table.hpp"
#include "store/dataset_path.hpp"
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
        {g + "kind", {}, {}, {}, {"sensitivity"}},
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
        {g + "kind", {}, {}, {}, {"screening"}},
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

/// Two chains of independent draws, and a meter that the posterior gets better.
/// \param distance  by which the second chain lies above the first
store::ResultFile posterior_result(double distance) {
    constexpr std::size_t n = 500;
    Stream random(3, 0, 0);
    std::vector<double> draws, density, prior, time;
    for (std::size_t k = 0; k < 2 * n; ++k) {
        const double sum = random.uniform() + random.uniform() + random.uniform();
        draws.push_back(sum + (k < n ? 0 : distance));
        density.push_back(random.uniform() + random.uniform());
        prior.push_back(10 * random.uniform());
    }
    for (int hour = 0; hour < 48; ++hour) time.push_back(3600.0 * hour);
    store::ResultFile result;
    result.attributes = {{"job", "seed = 1"}};
    const std::string g = "office/posterior/", m = g + "training/gas/";
    result.datasets = {
        {g + "kind", {}, {}, {}, {"posterior"}},
        {g + "unknown", {"unknown"}, {2}, {}, {"U_wall", "log_density"}},
        {g + "unknown_unit", {"unknown"}, {2}, {}, {"W/(m2 K)", "-"}},
        {g + "target_rhat", {}, {}, {1.01}, {}},
        {g + "target_ess", {}, {}, {400}, {}},
        {g + "posterior/U_wall", {"chain", "draw"}, {2, n}, draws, {}},
        {g + "sample_stats/lp", {"chain", "draw"}, {2, n}, density, {}},
        {g + "prior/U_wall", {"chain", "draw"}, {1, 2 * n}, prior, {}},
        {g + "data_words", {"unknown"}, {2}, {}, {"the data determine it", ""}},
        {m + "time", {"time"}, {48}, time, {}}};
    for (const std::string part : {"all", "training", "held_out_weeks"}) {
        const double error = part == "training" ? 0.1 : 0.4;
        const std::string p = m + part + "/";
        result.datasets.push_back({p + "metric", {"metric"}, {2}, {}, {"n", "cv_rmse"}});
        result.datasets.push_back({p + "validation_fit",
                                   {"version", "resolution", "metric"},
                                   {2, 3, 2},
                                   {48, 0.5, 2, 0.2, 0, 0, 48, error, 2, 0.05, 0, 0},
                                   {}});
        result.datasets.push_back({p + "guideline_14_met",
                                   {"version", "verdict"},
                                   {2, 2},
                                   {0, 0, error < 0.3 ? 1.0 : 0.0, 0},
                                   {}});
        result.datasets.push_back(
            {p + "coverage", {"interval"}, {4}, {0.47, 0.766, 0.5, 1}, {}});
    }
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

TEST(Tables, OfAPosteriorBeginWithItsConvergenceAndShowBeforeAndAfter) {
    const std::string text = tables_of(posterior_result(0));
    EXPECT_EQ(text.find("\noffice/posterior: converged: 2 chains of 500 draws"), 0U)
        << text;
    for (const char* part :
         {"U_wall", "W/(m2 K)", "training/gas training", "50.0 ->  10.0",
          "training/gas held_out_weeks", "50.0 ->  40.0", "hourly", "daily", "no -> yes",
          "76.6 %", "U_wall: the data determine it"})
        EXPECT_NE(text.find(part), std::string::npos) << part << text;
    EXPECT_EQ(text.find("training/gas all"), std::string::npos) << text;
    EXPECT_LE(widest_line(text), 100U) << text;
}

TEST(Tables, OfChainsThatDisagreeSayNotConvergedFirst) {
    const std::string text = tables_of(posterior_result(0.5));
    EXPECT_EQ(text.find("\noffice/posterior: NOT CONVERGED: "), 0U) << text;
}

TEST(Tables, AMissedTargetIsTheFirstLine) {
    store::ResultFile result = posterior_result(0.5);
    result.datasets.push_back(
        {"office/posterior/shortfall", {}, {}, {}, {"not converged: R-hat 1.4"}});
    result.complete = true;
    const std::string sentence =
        "NOT REACHED: office/posterior: not converged: R-hat 1.4";
    EXPECT_EQ(tables_of(result).find(sentence), 0U);
    EXPECT_NE(status_of(result).find(sentence), std::string::npos);
}

TEST(MergeChains, PutsOtherChainsOfOneJobTogetherAndNoOthers) {
    store::ResultFile second = posterior_result(0), third = posterior_result(0),
                      other = posterior_result(0);
    second.attributes["first_chain"] = "2";
    third.attributes["first_chain"] = "1";  // its first chain is the second of the first
    other.attributes = {{"job", "seed = 2"}, {"first_chain", "2"}};
    const auto merged = merge_chains({posterior_result(0), second, third, other});
    ASSERT_EQ(merged.size(), 3U);
    EXPECT_NE(tables_of(merged[0]).find("4 chains of 500 draws"), std::string::npos);
    for (const Dataset& dataset : merged[0].datasets)
        if (dataset.path.ends_with("prior/U_wall")) {
            EXPECT_EQ(dataset.shape[0], 1U);
        }
    EXPECT_NE(tables_of(merged[1]).find("2 chains of 500 draws"), std::string::npos);
}

TEST(MergeChains, CutsToTheDrawsThatAllHave) {
    store::ResultFile second = posterior_result(0);
    second.attributes["first_chain"] = "2";
    for (Dataset& dataset : second.datasets)
        if (dataset.dims.size() == 2 && !dataset.path.ends_with("prior/U_wall"))
            dataset = {dataset.path, dataset.dims, {2, 2}, {1, 2, 3, 4}, {}};
    const auto merged = merge_chains({posterior_result(0), second});
    ASSERT_EQ(merged.size(), 1U);
    for (const Dataset& dataset : merged[0].datasets)
        if (dataset.path.ends_with("sample_stats/lp")) {
            EXPECT_EQ(dataset.shape, (std::vector<std::size_t>{4, 2}));
            EXPECT_EQ(std::vector<double>(dataset.values.end() - 4, dataset.values.end()),
                      (std::vector<double>{1, 2, 3, 4}));
        }
}

}  // namespace
}  // namespace bemcal::report
