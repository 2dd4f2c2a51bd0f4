/// Warm-up windows, covariances, and step sizes that reach their target.
#include "sampling/adaptation.hpp"
#include "sampling/normal.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::sampling {
namespace {

TEST(Windows, AreStans) {
    // CmdStan's guide, "Automatic parameter tuning": 75, then 25, 50, 100, 200, 500, 50.
    EXPECT_EQ(windows_of(1000).begin, 75);
    EXPECT_EQ(windows_of(1000).ends, (std::vector<int>{99, 149, 249, 449, 949}));
    EXPECT_EQ(windows_of(500).ends, (std::vector<int>{99, 149, 249, 449}));
}

TEST(Windows, OfShortWarmUpsAreScaled) {
    EXPECT_EQ(windows_of(100).begin, 15);
    EXPECT_EQ(windows_of(100).ends, (std::vector<int>{89}));
    EXPECT_TRUE(windows_of(19).ends.empty());
    EXPECT_TRUE(windows_of(0).ends.empty());
}

TEST(Windows, LeaveTheLastTransitionsToTheStepSize) {
    for (int n = 20; n < 3000; n += 7) {
        const Windows windows = windows_of(n);
        ASSERT_FALSE(windows.ends.empty());
        EXPECT_EQ(windows.ends.back() + 1, n - (n < 150 ? n / 10 : 50));
        int before = windows.begin - 1;
        for (const int end : windows.ends) {
            EXPECT_GE(end - before, std::min(25, n / 2));
            before = end;
        }
    }
}

TEST(Covariance, OfKnownPoints) {
    RunningCovariance covariance(2, MetricShape::dense);
    for (const auto& x : {std::vector{1.0, 2.0}, {3.0, -2.0}, {5.0, 6.0}, {-1.0, 4.0}})
        covariance.add(x);
    // About the mean (2, 2.5): sums of squares 20 and 35, of products 2.
    const double w = 4.0 / 9, floor = 1e-3 * 5 / 9;
    const auto c = covariance.regularised(1);
    EXPECT_NEAR(c[0], w * 20 / 3 + floor, 1e-14);
    EXPECT_NEAR(c[1], w * 2 / 3, 1e-14);
    EXPECT_NEAR(c[2], w * 2 / 3, 1e-14);
    EXPECT_NEAR(c[3], w * 35 / 3 + floor, 1e-14);
    EXPECT_EQ(covariance.regularised(3)[1], 0) << "4 points are fewer than 3 each";
    EXPECT_EQ(covariance.regularised(3)[3], c[3]);
}

TEST(Metric, KeepsItsFactorWhereACovarianceHasNone) {
    Metric metric({0, 1}, MetricShape::dense);
    metric.set_covariance({4, 2, 2, 10});
    const std::vector<double> factor(metric.factor().begin(), metric.factor().end());
    EXPECT_EQ(factor, (std::vector<double>{2, 0, 1, 3}));
    metric.set_covariance({1, 2, 2, 1});
    EXPECT_EQ(std::vector<double>(metric.factor().begin(), metric.factor().end()),
              factor);
}

TEST(DualAveraging, ReachesItsTarget) {
    // An acceptance of exp(-step), noisy: 0.8 at 0.223.
    for (const double target : {0.8, 0.234, 0.44}) {
        DualAveraging tuner(target);
        Stream random(9, 9, 9);
        tuner.restart(10);
        double step = 10;
        for (int k = 0; k < 2000; ++k)
            step = tuner.learn(
                std::min(1.0, std::exp(-step) * (0.7 + 0.6 * random.uniform())));
        EXPECT_NEAR(std::exp(-tuner.averaged_step()), target, 0.02);
    }
}

}  // namespace
}  // namespace bemcal::sampling
