/// What all buildings of a stock have of their place, from made coefficients.
#include "base/random.hpp"
#include "stats/distributions.hpp"
#include "stock/common.hpp"
#include "stock/place.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::stock {
namespace {

const std::string station = "urban heat island or station offset";

/// Buildings of which each finds the mean with its own error and its own truth.
PlaceEffects stock_of(std::size_t n, double mean, std::uint64_t seed,
                      double spread = 0.3) {
    PlaceEffects effects;
    Stream random(seed, 0, 0);
    const auto normal = [&] { return stats::normal_quantile(random.uniform()); };
    for (std::size_t k = 0; k < n; ++k) {
        StockRecord record;
        record.of_the_place = {
            {station, "K", 1, mean + spread * normal() + 0.1 * normal(), 0.1},
            {"weather sensor in the sun", "K/(W/m2)", -0.004, 0.001 * normal(), 0.0005}};
        if (k % 10 == 3) record.of_the_place[0].coefficient = 9;  // far off
        effects.add(record);
    }
    return effects;
}

TEST(PlaceEffects, AStationThatIsOffIsFoundThoughAFewBuildingsAreFarOff) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto all = stock_of(40, -0.7, seed).of_all();
        ASSERT_EQ(all.size(), 2U);
        EXPECT_EQ(all[0].name, station);
        EXPECT_GT(all[0].probability, 0.8);
        EXPECT_NEAR(all[0].mean, -0.7, 0.25);
        EXPECT_NEAR(all[0].spread, 0.3, 0.3);
        EXPECT_NE(all[0].section.find("target = \"effect." + station + "\""),
                  std::string::npos);
        EXPECT_TRUE(all[1].section.empty());
        EXPECT_LT(all[0].probability + all[1].probability, 1);
    }
}

// Models are off by 0.2 of a typical size by themselves: that is no station. Twice as
// much is as likely as not, three times as much is one.
TEST(PlaceEffects, WhatModelsAreOffByThemselvesIsNone) {
    EXPECT_TRUE(stock_of(1000, 0.2, 1, 0.1).of_all()[0].section.empty());
    EXPECT_TRUE(stock_of(1000, 0.35, 1, 0.1).of_all()[0].section.empty());
    EXPECT_FALSE(stock_of(1000, 0.6, 1, 0.1).of_all()[0].section.empty());
}

TEST(PlaceEffects, OfFewerThanTenBuildingsNothingIsCommon) {
    EXPECT_TRUE(stock_of(9, -1.5, 1).of_all().empty());
    EXPECT_TRUE(datasets_of(stock_of(9, -1.5, 1).of_all()).empty());
    EXPECT_FALSE(datasets_of(stock_of(10, -1.5, 1).of_all()).empty());
}

// Nor do odds beyond all numbers, or a result that is damaged, end in none.
TEST(PlaceEffects, AreFoundWhateverTheOdds) {
    const auto far = stock_of(40, 100, 1).of_all();
    EXPECT_EQ(far[0].name, station);
    EXPECT_NEAR(far[0].probability, 1, 1e-12);
    PlaceEffects effects = stock_of(40, -0.7, 1);
    StockRecord damaged;
    damaged.of_the_place = {{station, "K", nan, 0, 0.1},
                            {station, "K", 1, nan, 0.1},
                            {station, "K", 1, 0, INFINITY}};
    effects.add(damaged);
    EXPECT_EQ(effects.of_all()[0].n, 40);
}

// A building takes it for something else as often as not; all together know better.
TEST(PlaceEffects, MakeANameLikelierInEachBuilding) {
    CommonEffects common;
    StockRecord record;
    record.known_to = 1;
    record.effects = {{"leaks", "1/h", "holds", "[[effect]]", 1, 0.9, 1.1}};
    record.names = {{0, "leaks", 0.6}, {0, station, 0.4}};
    for (int k = 0; k < 10; ++k) common.add(record);
    common.compare(stock_of(40, -0.7, 1).of_all());
    common.write(0, record);
    EXPECT_EQ(record.effects[0].by_stock, station);
}

}  // namespace
}  // namespace bemcal::stock
