/// Effects counted over the buildings of a stock.
#include "stock/common.hpp"
#include "study/columns.hpp"

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
    const auto datasets = common.datasets();
    EXPECT_EQ(study::find_dataset(datasets, "stock/stock_common_effect")->texts,
              (std::vector<std::string>{"own loads"}));
    EXPECT_TRUE(CommonEffects().datasets().empty());
}

}  // namespace
}  // namespace bemcal::stock
