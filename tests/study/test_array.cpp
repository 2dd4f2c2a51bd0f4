#include "study/array.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

using namespace bemcal::study;

TEST(Array, HasItsNumbersRowByRow) {
    Array array{{"model", "channel"}};
    array.resize({2, 3});
    EXPECT_TRUE(std::isnan(array.at({1, 2})));
    array.set({1, 0}, 7);
    array.set({0, 2}, 5);
    EXPECT_EQ(array.at({1, 0}), 7);
    EXPECT_EQ(array.values[3], 7);
    EXPECT_EQ(array.values[2], 5);
}

TEST(Array, HasNoPlaceBeyondItsEnds) {
    Array array{{"model", "channel"}};
    EXPECT_TRUE(std::isnan(array.at({0, 0})));
    array.resize({2, 3});
    for (double& value : array.values) value = 1;
    EXPECT_TRUE(std::isnan(array.at({0, 3})));
    EXPECT_TRUE(std::isnan(array.at({2, 0})));
    EXPECT_TRUE(std::isnan(array.at({0})));
    EXPECT_TRUE(std::isnan(array.at({0, 0, 0})));
    EXPECT_THROW(array.set({0, 3}, 1), std::logic_error);
    EXPECT_THROW(array.resize({2}), std::logic_error);
}

TEST(ArrayView, ShowsNumbersAndRowsOfADataset) {
    const Dataset dataset{"a", {"x", "y", "z"}, {2, 1, 2}, {1, 2, 3, 4}, {}};
    const ArrayView view(dataset);
    EXPECT_EQ(view.at({1, 0, 1}), 4);
    EXPECT_EQ(view.extent(2), 2U);
    EXPECT_EQ(view.extent(3), 0U);
    const auto row = view.part({1});
    EXPECT_EQ(std::vector<double>(row.begin(), row.end()), (std::vector<double>{3, 4}));
    EXPECT_TRUE(view.part({2}).empty());
    EXPECT_TRUE(std::isnan(ArrayView().at({0})));
}
