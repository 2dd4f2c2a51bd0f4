/// Effects counted over the buildings of a stock.
#include "stock/common.hpp"
#include "study/columns.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::stock {
namespace {

StockRecord building(std::vector<StockRecord::Effect> effects, double known_to = 1) {
    StockRecord record;
    record.known_to = known_to;
    record.effects = std::move(effects);
    return record;
}

std::vector<double> values(const std::vector<study::Dataset>& datasets,
                           const std::string& leaf) {
    const auto* found = study::find_dataset(datasets, "stock/" + leaf);
    return found == nullptr ? std::vector<double>{} : found->values;
}

TEST(CommonEffects, AreCountedWithTheQuartilesOfTheirCoefficients) {
    CommonEffects common;
    for (const double c : {1.0, 2.0, 3.0, 4.0, 5.0})
        common.add(building({{"wind", "1/h", "holds", "[[effect]]", c, c, c},
                             {"clock", "h", "ended", "[[effect]]", 1, 1, 1}}));
    common.add(building({{"sun", "K", "new", "[[effect]]", 7, 7, 7}}));
    common.add(building({}));
    common.add(building({}, 0));  // it was never searched
    common.compare();
    const auto datasets = common.datasets();
    EXPECT_EQ(study::find_dataset(datasets, "stock/stock_common_effect")->texts,
              (std::vector<std::string>{"wind", "sun"}));
    EXPECT_EQ(values(datasets, "stock_common_n"), (std::vector<double>{5, 1}));
    EXPECT_EQ(values(datasets, "stock_common_of"), (std::vector<double>{7, 7}));
    EXPECT_EQ(values(datasets, "stock_common_q25"), (std::vector<double>{2, 7}));
    EXPECT_EQ(values(datasets, "stock_common_median"), (std::vector<double>{3, 7}));
    EXPECT_EQ(values(datasets, "stock_common_q75"), (std::vector<double>{4, 7}));
}

TEST(CommonEffects, LeaveOutChangesWithoutAName) {
    CommonEffects common;
    StockRecord record = building({{"gas: all hours", "kWh/d", "new", "", 9, 8, 10},
                                   {"own loads", "1", "holds", "", 1, 1, 1}});
    record.changes = {{"gas: all hours", 20000, 9}};
    common.add(record);
    common.compare();
    const auto datasets = common.datasets();
    EXPECT_EQ(study::find_dataset(datasets, "stock/stock_common_effect")->texts,
              (std::vector<std::string>{"own loads"}));
    EXPECT_TRUE(CommonEffects().datasets().empty());
}

/// An effect that a building names so by itself.
StockRecord named(const std::vector<std::pair<std::string, double>>& names,
                  double coefficient = 1, double half = 0.1) {
    StockRecord record =
        building({{names[0].first, "K", "holds", "[[effect]]", coefficient,
                   coefficient - half, coefficient + half}});
    for (const auto& [name, probability] : names)
        record.names.push_back({0, name, probability});
    return record;
}

// Of one building alone nothing changes: an effect does not speak for itself.
TEST(CommonEffects, OfOneBuildingAreAsItFoundThem) {
    CommonEffects common;
    StockRecord record = named({{"station", 0.6}, {"recovery", 0.3}});
    common.add(record);
    common.compare();
    common.write(0, record);
    EXPECT_EQ(record.effects[0].by_stock, "station");
    EXPECT_NEAR(record.effects[0].by_stock_probability, 0.6, 1e-12);
    EXPECT_TRUE(std::isnan(record.effects[0].by_stock_coefficient));
}

// Forty buildings with an unsure name that is the same in all, among others that differ.
TEST(CommonEffects, ANameThatAllMayHaveIsLikelierInEach) {
    CommonEffects common;
    std::vector<StockRecord> records;
    records.reserve(40);
    for (int k = 0; k < 40; ++k)
        records.push_back(named({{"other " + std::to_string(k), 0.5}, {"station", 0.4}}));
    for (const StockRecord& record : records) common.add(record);
    common.compare();
    for (std::size_t k = 0; k < records.size(); ++k) {
        common.write(k, records[k]);
        EXPECT_EQ(records[k].effects[0].by_stock, "station");
        EXPECT_GT(records[k].effects[0].by_stock_probability, 0.9);
    }
    const auto datasets = common.datasets();
    EXPECT_EQ(study::find_dataset(datasets, "stock/stock_common_effect")->texts[0],
              "station");
    EXPECT_GT(values(datasets, "stock_common_expected")[0], 36);
    EXPECT_EQ(values(datasets, "stock_common_n")[0], 0);  // nobody named it first
}

// With two buildings: each sees one other that has a name with p; odds 1 + p to 1 + q.
TEST(CommonEffects, ProbabilitiesAreTheFixedPointOfOneAnother) {
    CommonEffects common;
    std::vector<StockRecord> records(2, named({{"a", 0.5}, {"b", 0.5}}));
    records[1] = named({{"a", 0.8}, {"b", 0.2}});
    for (const StockRecord& record : records) common.add(record);
    common.compare();
    for (std::size_t k = 0; k < 2; ++k) common.write(k, records[k]);
    const double p = records[0].effects[0].by_stock_probability,
                 q = records[1].effects[0].by_stock_probability;
    EXPECT_NEAR(p, (1 + q) / (1 + q + 1 + (1 - q)), 1e-5);
    EXPECT_NEAR(q, 0.8 * (1 + p) / (0.8 * (1 + p) + 0.2 * (1 + (1 - p))), 1e-5);
}

TEST(CommonEffects, WhatDidNotJoinIsNamedByTheStock) {
    CommonEffects common;
    std::vector<StockRecord> records(20, named({{"station", 0.9}}));
    StockRecord undecided = building({});
    undecided.names = {{of_what_did_not_join, "recovery", 0.45},
                       {of_what_did_not_join, "station", 0.4}};
    records.push_back(undecided);
    for (const StockRecord& record : records) common.add(record);
    common.compare();
    common.write(20, records[20]);
    EXPECT_EQ(records[20].undecided, "station");
    EXPECT_GT(records[20].undecided_probability, 0.8);
}

// Coefficients of 1, 2 and 3 with errors of 0.5: mean 2; spread by hand, Q = 8, so
// (8 - 2) / (12 - 48 / 12) = 0.75.
TEST(CommonEffects, SizesAreDrawnToTheStocks) {
    CommonEffects common;
    std::vector<StockRecord> records;
    for (const double c : {1.0, 2.0, 3.0})
        records.push_back(named({{"wind", 1.0}}, c, 0.5 * 1.645));
    for (const StockRecord& record : records) common.add(record);
    common.compare();
    const auto datasets = common.datasets();
    EXPECT_NEAR(values(datasets, "stock_common_mean")[0], 2, 1e-12);
    EXPECT_NEAR(values(datasets, "stock_common_spread")[0], std::sqrt(0.75), 1e-12);
    common.write(0, records[0]);
    EXPECT_NEAR(records[0].effects[0].by_stock_coefficient, (0.75 * 1 + 0.25 * 2) / 1,
                1e-12);
}

// A night begins from the record of the last, and an effect may have ended since.
TEST(CommonEffects, WhatTheLastNightSaidIsSaidAnew) {
    CommonEffects common;
    StockRecord record = named({{"wind", 1.0}});
    record.effects[0].state = "ended";
    record.effects[0].by_stock = "wind";
    record.effects[0].by_stock_probability = record.effects[0].by_stock_coefficient = 1;
    common.add(record);
    common.compare();
    common.write(0, record);
    EXPECT_EQ(record.effects[0].by_stock, "");
    EXPECT_TRUE(std::isnan(record.effects[0].by_stock_probability));
    EXPECT_TRUE(std::isnan(record.effects[0].by_stock_coefficient));
}

TEST(CommonEffects, AnEffectWithoutAnyNameIsLeftOut) {
    CommonEffects common;
    StockRecord record = building({{"", "K", "holds", "[[effect]]", 1, 1, 1}});
    common.add(record);
    common.compare();
    common.write(0, record);
    EXPECT_EQ(record.effects[0].by_stock, "");
    EXPECT_TRUE(common.datasets().empty());
}

}  // namespace
}  // namespace bemcal::stock
