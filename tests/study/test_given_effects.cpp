#include "study/given_effects.hpp"

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

GivenEffect effect(const char* name, std::vector<double> values) {
    return {name, {{"infiltration", "1/h", false, "", "", std::move(values)}}};
}

TEST(GivenEffects, AreScaledHourByHourAndLeftOutAtNothing) {
    const std::vector<GivenEffect> all{
        effect("leaks", {1, 2}), effect("doors", {3, 4}), {"unknown to the program", {}}};
    const auto some = scaled(all, std::vector{0.5, 0.0, 1.0});
    ASSERT_EQ(some.size(), 1U);
    EXPECT_EQ(some[0].name, "leaks");
    EXPECT_EQ(some[0].at[0].values, (std::vector<double>{0.5, 1}));
    EXPECT_EQ(scaled(all, std::vector{1.0}).size(), 1U);  // others have no scale
}

}  // namespace
}  // namespace bemcal::study
