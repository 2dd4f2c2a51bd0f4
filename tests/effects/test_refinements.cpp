/// Refinements of a zone: their numbers, their limits, what they share.
#include "effects/refinements.hpp"
#include "office.hpp"
#include "physics/numbers.hpp"

#include <set>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using physics::Parameter;
using test::Office;

const Refinement& named(const std::string& name) {
    return *std::ranges::find(refinements(), name, &Refinement::name);
}

TEST(Refinements, HaveNamesThatPartAStructure) {
    std::set<std::string> names;
    for (const Refinement& refinement : refinements()) {
        EXPECT_TRUE(names.insert(refinement.name).second) << refinement.name;
        EXPECT_EQ(std::string(refinement.name).find('+'), std::string::npos);
    }
    EXPECT_EQ(name_of(std::vector<std::size_t>{}), "standard");
    EXPECT_EQ(name_of(std::vector<std::size_t>{0, 1}), "surfaces + air and thermostat");
}

TEST(Refinements, OfOneKindAreNotTogether) {
    const auto index = [](const char* name) {
        return static_cast<std::size_t>(&named(name) - refinements().data());
    };
    EXPECT_TRUE(are_of_one_kind(index("sky"), index("sky by weather")));
    EXPECT_TRUE(are_of_one_kind(index("surfaces"), index("surfaces")));
    EXPECT_TRUE(are_of_one_kind(index("rooms that differ"), index("one unit for all")));
    EXPECT_FALSE(are_of_one_kind(index("surfaces"), index("sky")));
}

TEST(Refinements, OneUnitForAllIsOfAnAirSystemWithHours) {
    physics::Building building = Office().building;
    const Refinement& unit = named("one unit for all");
    physics::Zone& zone = building.zones[0];
    physics::Input& available =
        building.air_systems[static_cast<std::size_t>(zone.air_system)].available;
    const int hours = available.profile;
    available.profile = -1;
    EXPECT_FALSE(unit.change(building)) << "it never stands";
    available.profile = hours;
    EXPECT_TRUE(unit.change(building));
    EXPECT_EQ(zone.thermostat.cooled_together.value, 0) << "while it runs by its hours";
    EXPECT_EQ(zone.thermostat.cooled_together.low, 1);
    EXPECT_EQ(zone.thermostat.cooled_together.profile, hours);
    zone.air_system = -1;
    EXPECT_FALSE(unit.change(building));
}

TEST(Refinements, ANumberStandsAtItsMeanAndIsAParameter) {
    physics::Building building = Office().building;
    const Refinement::Number& ratio = named("surfaces").numbers[0];
    const auto parameter = add_number(ratio, {}, building);
    ASSERT_TRUE(parameter);
    EXPECT_EQ(parameter->name, "mass_area_ratio");
    EXPECT_EQ(parameter->nominal, 2.5);
    EXPECT_EQ(parameter->least, 1.0);  // its own end is nearer than 2.5 sd
    EXPECT_EQ(parameter->most, 2.5 + 2.5 * 0.8);
    EXPECT_EQ(physics::number_at(building, parameter->targets[0]), 2.5);
    EXPECT_EQ(physics::path_of(building, parameter->targets[0]),
              "zone.office.mass_area_ratio");
}

TEST(Refinements, ANumberThatIsTakenKeepsItsPrior) {
    physics::Building building = Office().building;
    const Refinement::Number& ratio = named("surfaces").numbers[0];
    Parameter taken;
    taken.name = "ratio";
    taken.targets = physics::resolve(building, ratio.path);
    const double before = physics::number_at(building, taken.targets[0]);
    EXPECT_FALSE(add_number(ratio, {taken}, building));
    EXPECT_EQ(physics::number_at(building, taken.targets[0]), before);
    // Another number has its name.
    taken.name = ratio.name;
    taken.targets = physics::resolve(building, "zone.*.volume");
    EXPECT_EQ(add_number(ratio, {taken}, building)->name,
              "mass_area_ratio of the structure");
}

TEST(Refinements, ASeasonIsOfWhatHeats) {
    physics::Building building = Office().building;
    const Refinement& heating = named("heating season");
    EXPECT_TRUE(heating.change(building));
    EXPECT_EQ(add_number(heating.numbers[0], {}, building)->unit, "degC");
    EXPECT_EQ(building.zones[0].structure.heating_limit, 15);
    building.zones[0].thermostat.cooling_capacity.value = 0;
    EXPECT_TRUE(heating.change(building));
    building.zones[0].radiator.emplace();
    EXPECT_FALSE(heating.change(building));
    building.zones[0].radiator.reset();
    building.zones[0].thermostat.imposed = true;
    EXPECT_FALSE(heating.change(building));
}

TEST(Refinements, LimitsAreTheNearerOfPriorAndRange) {
    EXPECT_EQ(limits_of(10, 2, 0, 12), std::pair(5.0, 12.0));
    EXPECT_EQ(limits_of(10, 2, 6, 99), std::pair(6.0, 15.0));
}

}  // namespace
}  // namespace bemcal::effects
