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
    EXPECT_TRUE(
        are_of_one_kind(index("coil that dries"), index("terminals with reheat")));
    EXPECT_FALSE(are_of_one_kind(index("surfaces"), index("sky")));
}

TEST(Refinements, OneTakesThePlaceOfAnotherOfItsKind) {
    const auto of = [](const char* name) {
        return static_cast<std::size_t>(&named(name) - refinements().data());
    };
    const std::vector<std::size_t> structure = {of("sky"), of("surfaces")};
    EXPECT_EQ(joined_by(of("sky by weather"), structure, {}),
              (std::vector{of("surfaces"), of("sky by weather")}));
    EXPECT_EQ(joined_by(of("emitter"), structure, {}),
              (std::vector{of("sky"), of("surfaces"), of("emitter")}));
    EXPECT_EQ(joined_by(of("sky"), structure, {}), std::nullopt) << "it is there";
    EXPECT_EQ(joined_by(of("sky"), {}, {of("sky by weather")}), std::nullopt)
        << "what is declared stays";
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

/// The office without its air system, with a parameter, a link and an effect that lead to
/// its fans.
physics::Building office_with_fans() {
    physics::Building building = Office().building;
    building.zones[0].air_system = building.zones[0].system_flow = -1;
    building.air_systems.clear();
    return building;
}

TEST(Refinements, TerminalsAreOfWhatIsHeatedAndCooledByAFan) {
    const Refinement& terminals = named("terminals with reheat");
    const auto finds = [&](auto lacks) {
        physics::Building building = office_with_fans();
        lacks(building.zones[0]);
        return terminals.change(building);
    };
    EXPECT_TRUE(finds([](physics::Zone&) {}));
    EXPECT_FALSE(finds([](auto& zone) { zone.thermostat.cooling_capacity = {0}; }));
    EXPECT_FALSE(finds([](auto& zone) { zone.thermostat.heating_capacity = {0}; }));
    EXPECT_FALSE(finds([](auto& zone) { zone.flows[1].air_change.profile = -1; }));
    physics::Building declared = Office().building;
    EXPECT_FALSE(terminals.change(declared)) << "it has an air system";
}

TEST(Refinements, WhatLedToAFanLeadsToOutdoorAirBehindTerminals) {
    physics::Building building = office_with_fans();
    const char* path = "zone.office.flow.fans.air_change";
    const physics::Target fan = physics::resolve(building, path)[0];
    physics::Target change = fan;
    change.slot = physics::Slot::change;
    building.effects.push_back({"dust", "-", 0, 1, {change}});
    building.zones[0].flows[1].air_change.changes = {{0.3, test::night_row}};
    building.links.push_back({{fan}, {fan}, {}, {}});
    ASSERT_TRUE(named("terminals with reheat").change(building));

    const physics::Target air =
        physics::resolve(building, "air_system.of office.outdoor_air_change")[0];
    EXPECT_TRUE(physics::is_same_number(physics::resolve(building, path)[0], air));
    EXPECT_TRUE(physics::is_same_number(building.links[0].targets[0], air));
    EXPECT_TRUE(physics::is_same_number(building.links[0].sources[0], air));
    change = air;
    change.slot = physics::Slot::change;
    EXPECT_TRUE(physics::is_same_number(building.effects[0].targets[0], change));
    const physics::Input& outdoor_air = building.air_systems[0].outdoor_air_change;
    EXPECT_EQ(outdoor_air.value, 1);
    EXPECT_EQ(outdoor_air.profile, test::office_hours_row);
    EXPECT_EQ(outdoor_air.changes[0].amount, 0.3);
    EXPECT_FALSE(building.zones[0].flows[1].air_change.is_anything());
    const physics::AirFlow& least = building.zones[0].flows.back();
    EXPECT_EQ(least.heat_recovery.value, 0.2);
    EXPECT_EQ(least.air_change.profile, test::office_hours_row);
}

/// The same as if somebody had declared it.
TEST(Refinements, TerminalsAreAnAirSystemOfVaryingFlow) {
    const Office office;
    physics::Building found = office_with_fans(), declared = office_with_fans();
    const Refinement& terminals = named("terminals with reheat");
    ASSERT_TRUE(terminals.change(found));
    for (const Refinement::Number& number : terminals.numbers)
        ASSERT_TRUE(add_number(number, {}, found)) << number.name;

    physics::Zone& zone = declared.zones[0];
    declared.boundaries.push_back({"supply", {13}});
    physics::AirSystem unit;
    unit.name = "unit";
    unit.available = {1, 0, test::office_hours_row};
    unit.outdoor_air_change = {1, 0, test::office_hours_row};
    unit.design_flow = {15};
    unit.fan_power = {1};
    unit.bypass_factor = 0.1;
    unit.people_moisture = {3, 0, test::office_hours_row};
    declared.air_systems.push_back(unit);
    zone.flows[1].air_change = {1.5, 0, test::office_hours_row};
    zone.flows[1].supply = 1;
    zone.air_system = 0;
    zone.system_flow = 1;
    const auto heat = [&](const physics::Building& building) {
        return physics::predict(building, office.drive,
                                physics::simulate(building, office.drive),
                                physics::Quantity::heating);
    };
    const std::vector<double> as_found = heat(found), as_declared = heat(declared);
    double reheat = 0;
    for (std::size_t k = 0; k < as_found.size(); ++k) {
        EXPECT_NEAR(as_found[k], as_declared[k], 1e-9 * (1 + as_declared[k])) << k;
        reheat += as_found[k];
    }
    EXPECT_GT(reheat, test::total(heat(office_with_fans())));
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

TEST(Refinements, AStartIsSlowWhereASetPointHasHours) {
    physics::Building building = Office().building;
    const Refinement& slow = named("slow start");
    physics::Thermostat& control = building.zones[0].thermostat;
    control.heating_set_point.profile = control.cooling_set_point.profile = -1;
    EXPECT_FALSE(slow.change(building));
    control.cooling_set_point.profile = 0;
    EXPECT_TRUE(slow.change(building));
    control.imposed = true;
    EXPECT_FALSE(slow.change(building));
}

TEST(Refinements, LimitsAreTheNearerOfPriorAndRange) {
    EXPECT_EQ(limits_of(10, 2, 0, 12), std::pair(5.0, 12.0));
    EXPECT_EQ(limits_of(10, 2, 6, 99), std::pair(6.0, 15.0));
}

}  // namespace
}  // namespace bemcal::effects
