#include "effects/catalogue.hpp"
#include "effects/hook_series.hpp"
#include "effects/hooks.hpp"
#include "effects/sites.hpp"
#include "office.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;
using test::Quantity;

const Office& office() {
    static const Office one;
    return one;
}

/// What an effect of this size changes.
std::vector<HookSeries> changes_of(const Effect& effect, double coefficient) {
    const Placed placed = place(std::span(&effect, 1), office().around);
    physics::Building with = placed.building;
    physics::apply(placed.building, placed.parameters, std::vector{coefficient}, with);
    return changes_between({placed.building, placed.drive}, {with, placed.drive});
}

Effect effect_at(Hook hook) {
    Effect effect{.name = name_of(hook), .hook = hook};
    if (row_of(hook).is_at_a_meter) effect.meter = Quantity::gas;
    return effect;
}

/// The only one, of a constant effect of 0.2; its first value.
double only_change(Hook hook, const std::string& called, bool is_factor) {
    const auto all = changes_of(effect_at(hook), 0.2);
    if (all.size() != 1) {
        ADD_FAILURE() << name_of(hook) << " gives " << all.size() << " series";
        return 0;
    }
    EXPECT_EQ(all[0].hook, called);
    EXPECT_EQ(all[0].is_factor, is_factor);
    return *std::ranges::max_element(all[0].values);
}

TEST(HookSeries, AConstantEffectIsItsCoefficientAtItsHook) {
    EXPECT_NEAR(only_change(Hook::infiltration, "infiltration", false), 0.2, 1e-12);
    EXPECT_NEAR(only_change(Hook::gains, "gains", false), 0.2, 1e-12);
    EXPECT_NEAR(only_change(Hook::lights_and_equipment, "lights and equipment", false),
                0.2, 1e-12);
    EXPECT_NEAR(only_change(Hook::heating_set_point, "heating set-point", false), 0.2,
                1e-12);
    EXPECT_NEAR(only_change(Hook::cooling_set_point, "cooling set-point", false), 0.2,
                1e-12);
    EXPECT_NEAR(only_change(Hook::heating_efficiency, "heating efficiency", true), 0.2,
                1e-12);
    EXPECT_NEAR(only_change(Hook::cooling_cop, "cooling COP", true), 0.2, 1e-12);
    EXPECT_NEAR(only_change(Hook::window_conductance, "window conductance", true), 0.2,
                1e-12);
    EXPECT_NEAR(only_change(Hook::meter_addition, "meter addition", false), 0.2, 1e-12);
}

TEST(HookSeries, AirOfFansIsAShareOfTheirMost) {
    const physics::Building& building = office().building;
    for (const physics::AirFlow& flow : building.zones[0].flows)
        if (is_fan(flow)) {
            const auto all = changes_of(effect_at(Hook::ventilation), 0.2);
            ASSERT_EQ(all.size(), 1U);
            EXPECT_EQ(all[0].hook, "ventilation");
            EXPECT_EQ(all[0].unit, "-");
            EXPECT_NEAR(*std::ranges::max_element(all[0].values), 0.2, 1e-9);
            return;
        }
    FAIL() << "the office has no fan";
}

TEST(HookSeries, OpeningsSayFromWhatTheyOpen) {
    Effect effect = effect_at(Hook::venting);
    effect.shape.at = 22;
    const auto all = changes_of(effect, 2);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].opens_above, 22);
}

TEST(HookSeries, FacadesThatChangeAlikeAreOne) {
    const auto all = changes_of(effect_at(Hook::aperture), -0.2);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].hook, "aperture");
    EXPECT_EQ(all[0].facade, "");
    EXPECT_NEAR(all[0].values[0], -0.2, 1e-12);
}

TEST(HookSeries, OneFacadeIsCalledByItsSide) {
    Effect effect = effect_at(Hook::aperture);
    effect.facade = office().building.zones[0].windows[0].plane;
    const auto all = changes_of(effect, -0.2);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].facade, "south facade");
}

TEST(HookSeries, AMeterIsCalledByWhatItShows) {
    const auto all = changes_of(effect_at(Hook::meter_factor), 0.2);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].meter, "gas");
}

TEST(HookSeries, FollowsWhatTheEffectFollows) {
    Effect effect = effect_at(Hook::infiltration);
    effect.driver = Driver::wind;
    effect.is_smooth = true;
    const auto all = changes_of(effect, 0.1);
    ASSERT_EQ(all.size(), 1U);
    const auto& wind = office().around.weather.at(Driver::wind);
    const auto first = static_cast<std::size_t>(office().drive.n_warm_up);
    ASSERT_EQ(all[0].values.size(), wind.size() - first);
    for (std::size_t h = 0; h < all[0].values.size(); h += 97)
        EXPECT_NEAR(all[0].values[h], 0.1 * wind[first + h], 1e-9) << h;
}

// Schedules that move change all that follows them: set-points, flows and loads, loads of
// a kind added up.
TEST(HookSeries, SchedulesThatMoveChangeAllThatFollowsThem) {
    Effect effect = effect_at(Hook::operation);
    effect.driver = Driver::shifted_hours;
    effect.shape.at = 1;
    std::vector<std::string> hooks;
    for (const HookSeries& series : changes_of(effect, 1)) {
        hooks.push_back(series.hook);
        EXPECT_NEAR(std::accumulate(series.values.begin(), series.values.end(), 0.0) /
                        static_cast<double>(series.values.size()),
                    0, 0.05)
            << series.hook << ": as much earlier as later";
    }
    for (const char* hook : {"heating set-point", "lights and equipment", "gains"})
        EXPECT_NE(std::ranges::find(hooks, hook), hooks.end()) << hook;
    auto sorted = hooks;
    std::ranges::sort(sorted);
    EXPECT_EQ(std::ranges::adjacent_find(sorted), sorted.end()) << "each hook once";
}

TEST(HookSeries, NothingChangesWithoutACoefficient) {
    for (const Entry& entry : catalogue()) try {
            EXPECT_TRUE(changes_of(entry.effect, 0).empty()) << entry.effect.name;
        } catch (const std::exception&) {
            // It cannot enter this office.
        }
}

TEST(HookSeries, PeriodsFollowEachOther) {
    std::vector<HookSeries> all{{"gains", "W/m2", false, "", "", {1, 2}}};
    append(all, 2, {{"infiltration", "1/h", false, "", "", {3}}}, 1);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].values, (std::vector<double>{1, 2, 0}));
    EXPECT_EQ(all[1].values, (std::vector<double>{0, 0, 3}));
    append(all, 3, {{"gains", "W/m2", false, "", "", {4}}}, 1);
    EXPECT_EQ(all[0].values, (std::vector<double>{1, 2, 0, 4}));
    EXPECT_EQ(all[1].values, (std::vector<double>{0, 0, 3, 0}));
}

}  // namespace
}  // namespace bemcal::effects
