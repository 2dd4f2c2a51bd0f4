/// Quantiles of a sample against numpy.quantile, whose default is type 7, too.
#include "stats/quantile.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

TEST(Quantile, LiesBetweenNeighboursAsNumpyPutsIt) {
    const std::vector<double> sorted = {1, 2, 4, 8, 16};
    // numpy.quantile([1, 2, 4, 8, 16], [0, 0.05, 0.3, 0.5, 0.95, 1])
    EXPECT_EQ(quantile_of_sorted(sorted, 0), 1);
    EXPECT_DOUBLE_EQ(quantile_of_sorted(sorted, 0.05), 1.2);
    EXPECT_DOUBLE_EQ(quantile_of_sorted(sorted, 0.3), 2.4);
    EXPECT_EQ(quantile_of_sorted(sorted, 0.5), 4);
    EXPECT_DOUBLE_EQ(quantile_of_sorted(sorted, 0.95), 14.4);
    EXPECT_EQ(quantile_of_sorted(sorted, 1), 16);
}

TEST(Quantile, OfOneValueIsItAndOfNoneNaN) {
    EXPECT_EQ(quantile_of_sorted(std::vector<double>{3}, 0.9), 3);
    EXPECT_TRUE(std::isnan(quantile_of_sorted({}, 0.5)));
}

}  // namespace
}  // namespace bemcal::stats
