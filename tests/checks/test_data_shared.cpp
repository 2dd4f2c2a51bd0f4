#include "checks/data_shared.hpp"
#include "checks/made_meters.hpp"

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

TEST(Proportions, OfAMetersShareAreFoundThroughItsRounding) {
    const MadeMeter meter = made_electricity(0, 100);
    std::vector<double> share = meter.values;
    for (double& value : share) value = std::round(100 * 0.337 * value) / 100;
    for (std::size_t k = 0; k < 100; ++k) share[k] = std::nan("");
    const checks::Proportion found = checks::proportion_of(meter.values, share);
    EXPECT_GT(found.share, 0.99);
    EXPECT_NEAR(found.ratio, 0.337, 0.001);
}

TEST(Proportions, OfATenthOfOtherReadingsAreNoLongerNine) {
    const MadeMeter meter = made_electricity(0, 100);
    std::vector<double> other = meter.values;
    for (std::size_t k = 0; k < other.size(); k += 7) other[k] *= 1.1;
    const checks::Proportion found = checks::proportion_of(meter.values, other);
    EXPECT_NEAR(found.share, 6.0 / 7, 0.02);
}

TEST(Proportions, OfMetersThatHardlyVaryOrHardlyMeetAreNotJudged) {
    const std::vector<double> flat(1000, 5), few(100, 5);
    EXPECT_EQ(checks::proportion_of(flat, flat).n, 0);
    EXPECT_EQ(checks::proportion_of(flat, few).n, 0);
    EXPECT_EQ(checks::proportion_of(few, std::vector<double>(100, std::nan(""))).n, 0);
}

// 200 pairs of clean meters of buildings with the same hours.
TEST(CleanMeters, AreNotShared) {
    const MadeMeter first = made_electricity(0, 550);
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
        EXPECT_LT(checks::proportion_of(first.values, made_meter(seed).values).share, 0.7)
            << seed;
}

}  // namespace
}  // namespace bemcal::stats
