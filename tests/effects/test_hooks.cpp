/// The rows of hooks and drivers, and what is looked up in them.
#include "effects/drivers.hpp"
#include "effects/hooks.hpp"
#include "effects/sites.hpp"
#include "office.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

TEST(Hooks, HaveEachANameOfTheirOwnAndAUnit) {
    std::set<std::string> names;
    for (const HookRow& row : hook_rows()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_STRNE(row.unit, "") << row.name;
        EXPECT_STREQ(name_of(row.hook), row.name);
        EXPECT_STREQ(unit_of(row.hook), row.unit);
    }
}

TEST(Hooks, FollowGroupsThatSomeDriverFills) {
    unsigned filled = 0, known = 0;
    for (const DriverRow& driver : driver_rows())
        for (const Cells& cells : driver.grammar) filled |= cells.group;
    for (const GroupRow& group : group_rows) known |= group.group;
    EXPECT_EQ(filled, known);
    for (const HookRow& row : hook_rows()) {
        EXPECT_EQ(row.grammar.follows & ~known, 0u) << row.name;
        EXPECT_EQ(row.grammar.follows != 0, row.grammar.most > 0) << row.name;
        EXPECT_LE(row.grammar.typical, row.grammar.most) << row.name;
    }
}

TEST(Drivers, HaveEachANameOfTheirOwn) {
    std::set<std::string> names;
    for (const DriverRow& row : driver_rows()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_STREQ(name_of(row.driver), row.name);
    }
}

TEST(Drivers, AreSeriesOverTheStepsWhereTheOfficeHasThem) {
    const test::Office office;
    for (const DriverRow& row : driver_rows()) {
        const Effect effect{.driver = row.driver, .column = "rain"};
        EXPECT_EQ(driver_of(effect, office.around).size(),
                  static_cast<std::size_t>(office.drive.n_steps()))
            << row.name;
    }
}

TEST(FirstMoves, AreTheDriversOrTheOpeningsOwn) {
    const auto move = [](Hook hook, Driver driver) {
        return first_move(
            {.hook = hook, .driver = driver, .shape = {Form::within, 1, 2}});
    };
    EXPECT_EQ(move(Hook::gains, Driver::day_of_year), 14);
    EXPECT_EQ(move(Hook::gains, Driver::elapsed), 0.04);
    EXPECT_EQ(move(Hook::gains, Driver::hour), 1);
    EXPECT_EQ(move(Hook::operation, Driver::shifted_hours), 1);
    EXPECT_EQ(move(Hook::neighbour, Driver::constant_temperature), 2);
    EXPECT_EQ(move(Hook::aperture, Driver::bright), 50);
    EXPECT_EQ(move(Hook::infiltration, Driver::wind), 0);
    EXPECT_EQ(move(Hook::venting, Driver::one), 1.5);
}

TEST(FirstMoves, AreOfNumbersThatSaySomething) {
    const auto of_linear = [](Hook hook, Driver driver) {
        return first_move({.hook = hook, .driver = driver});
    };
    EXPECT_EQ(of_linear(Hook::opaque_boundary, Driver::sun_horizontal), 0);
    EXPECT_EQ(of_linear(Hook::gains, Driver::elapsed), 0);
    EXPECT_EQ(of_linear(Hook::operation, Driver::shifted_hours), 1);
    EXPECT_EQ(of_linear(Hook::neighbour, Driver::constant_temperature), 2);
    EXPECT_EQ(of_linear(Hook::venting, Driver::one), 1.5);
}

TEST(Hooks, LightsAreLoadsThatAreNamedSo) {
    const auto is_light = [](const char* name, double heat_fraction = 1) {
        physics::Load load;
        load.name = name;
        load.heat_fraction = heat_fraction;
        return lights_a_zone(load);
    };
    for (const char* name : {"light", "lights", "Lighting east", "LIGHTS"})
        EXPECT_TRUE(is_light(name)) << name;
    for (const char* name : {"lights and equipment", "floodlights", "equipment", "ligh"})
        EXPECT_FALSE(is_light(name)) << name;
    EXPECT_FALSE(is_light("lights outdoors", 0));
}

TEST(Hooks, EquipmentIsWhatIsNamedSo) {
    const auto is_equipment = [](const char* name) {
        physics::Load load;
        load.name = name;
        return equips_a_zone(load);
    };
    for (const char* name : {"equipment", "Equip 1", "plugs", "devices", "Appliances"})
        EXPECT_TRUE(is_equipment(name)) << name;
    for (const char* name : {"equipment and lights", "lights", "people", "servers"})
        EXPECT_FALSE(is_equipment(name)) << name;
}

}  // namespace
}  // namespace bemcal::effects
