#include "loop/stored_simulator.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

using study::GivenEffect;

/// Two of one name, and one that changes nothing.
const std::vector<GivenEffect> effects{
    {"a step",
     {{"infiltration", "1/h", false, "", "", {1, 2}},
      {"aperture", "-", true, "south facade", "", {-0.5, 0}}}},
    {"nothing it knows", {}},
    {"a step",
     {{"meter factor", "-", true, "", "gas", {0, 0.25}},
      {"venting", "1/h", false, "", "", {2, 0}, 23}}}};

void expect_same(const GivenEffect& one, const GivenEffect& other) {
    EXPECT_EQ(one.name, other.name);
    ASSERT_EQ(one.at.size(), other.at.size());
    for (std::size_t k = 0; k < one.at.size(); ++k) {
        EXPECT_EQ(one.at[k].hook, other.at[k].hook);
        EXPECT_EQ(one.at[k].unit, other.at[k].unit);
        EXPECT_EQ(one.at[k].is_factor, other.at[k].is_factor);
        EXPECT_EQ(one.at[k].facade, other.at[k].facade);
        EXPECT_EQ(one.at[k].meter, other.at[k].meter);
        EXPECT_EQ(one.at[k].values, other.at[k].values);
        const double above = one.at[k].opens_above, back = other.at[k].opens_above;
        EXPECT_TRUE(above == back || (std::isnan(above) && std::isnan(back)));
    }
}

StoredSimulator filled(const std::vector<double>& scales) {
    StoredSimulator stored;
    add_given(effects, scales, stored);
    return stored_simulator(datasets_of("office/loop", stored), "office/loop");
}

TEST(StoredSimulator, EffectsComeBackFromTheirDatasets) {
    const auto back = given_in(filled({1, 1, 1}));
    ASSERT_EQ(back.size(), effects.size());
    for (std::size_t k = 0; k < back.size(); ++k) expect_same(back[k], effects[k]);
}

TEST(StoredSimulator, EffectsAreTimesTheirScales) {
    const StoredSimulator stored = filled({2, 1, 0});
    EXPECT_EQ(stored.series.size(), 2U);
    EXPECT_EQ(stored.given[0].hooks, "infiltration, aperture");
    EXPECT_EQ(stored.given[1].hooks, "");
    EXPECT_EQ(stored.given[2].scale, 0);
    const auto back = given_in(stored);
    EXPECT_EQ(back[0].at[0].values, (std::vector<double>{2, 4}));
    EXPECT_TRUE(back[2].at.empty());
}

}  // namespace
}  // namespace bemcal::loop
