#include "base/nan.hpp"
#include "posterior/own_bias.hpp"

#include <gtest/gtest.h>

namespace bemcal::posterior {
namespace {

/// Two readings that sum to `metered`, one missing between them, and 101 draws whose sums
/// over the two are 0, 1, ... 100: their 98 % interval is 1 to 99.
MeterPrediction metered(double metered) {
    MeterPrediction meter;
    meter.measured = {metered / 4, nan, metered * 3 / 4};
    meter.draws = Matrix(101, 3);
    for (std::size_t r = 0; r < 101; ++r) {
        const auto sum = static_cast<double>((r * 37) % 101);  // in no order
        meter.draws(r, 0) = sum / 2;
        meter.draws(r, 1) = 1e6;
        meter.draws(r, 2) = sum / 2;
    }
    return meter;
}

TEST(OwnBias, IsToldByDrawsThatHoldTheTotal) {
    EXPECT_TRUE(draws_tell_bias(metered(50), 0.2));
    EXPECT_TRUE(draws_tell_bias(metered(1.01), 0.2));
    EXPECT_TRUE(draws_tell_bias(metered(98.99), -0.2));
}

TEST(OwnBias, OfATotalOutsideOfTheDrawsIsNotToldByThem) {
    EXPECT_FALSE(draws_tell_bias(metered(0.99), 0.2));
    EXPECT_FALSE(draws_tell_bias(metered(99.01), -0.2));
    EXPECT_FALSE(draws_tell_bias(metered(500), -0.2));
}

TEST(OwnBias, Beyond25PercentIsNotToldWhateverTheDrawsHold) {
    EXPECT_TRUE(draws_tell_bias(metered(50), 0.24));
    EXPECT_TRUE(draws_tell_bias(metered(50), -0.24));
    EXPECT_FALSE(draws_tell_bias(metered(50), 0.26));
    EXPECT_FALSE(draws_tell_bias(metered(50), -0.26));
    EXPECT_FALSE(draws_tell_bias(metered(50), nan));
}

TEST(OwnBias, IsNotToldWithoutDraws) {
    MeterPrediction meter = metered(50);
    meter.draws = {};
    EXPECT_FALSE(draws_tell_bias(meter, 0.01));
}

}  // namespace
}  // namespace bemcal::posterior
