#include "study/hold_out.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

std::vector<physics::Seconds> hours(int n) {
    std::vector<physics::Seconds> begins;
    for (int k = 0; k < n; ++k)
        begins.push_back(physics::parse_time("2021-01-07") + std::chrono::hours(k));
    return begins;
}

double share_of(const std::vector<Role>& roles, Role role) {
    return static_cast<double>(std::ranges::count(roles, role)) /
           static_cast<double>(roles.size());
}

TEST(HoldOut, WithoutSharesAllReadingsTrain) {
    EXPECT_EQ(share_of(draw_roles(hours(500), 0, {}), Role::training), 1);
}

/// 500 weeks and the hours of the others: 5 standard errors, once in 1.7 million.
TEST(HoldOut, SharesAreAsAsked) {
    const auto roles = draw_roles(hours(500 * 168), 0, {0.25, 0.2, 3});
    EXPECT_NEAR(share_of(roles, Role::held_out_week), 0.25, 5 * 0.0194);
    const double rest = 1 - share_of(roles, Role::held_out_week);
    EXPECT_NEAR(share_of(roles, Role::held_out_hour) / rest, 0.2, 5 * 0.0016);
}

TEST(HoldOut, AWeekIsHeldOutWholeAndForEveryMeter) {
    const HoldOut hold_out{0.3, 0.3, 8};
    const auto one = draw_roles(hours(52 * 168), 0, hold_out);
    const auto other = draw_roles(hours(52 * 168), 1, hold_out);
    bool differs = false;
    for (std::size_t k = 0; k < one.size(); ++k) {
        const std::size_t first = k / 168 * 168;  // begins on a Thursday, as 1970 did
        EXPECT_EQ(one[k] == Role::held_out_week, one[first] == Role::held_out_week);
        EXPECT_EQ(one[k] == Role::held_out_week, other[k] == Role::held_out_week);
        differs = differs || one[k] != other[k];
    }
    EXPECT_TRUE(differs);  // single hours are each meter's own
}

}  // namespace
}  // namespace bemcal::study
