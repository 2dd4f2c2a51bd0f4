/// The table of a building's numbers, paths into it, and points written through it.
#include "physics/parameters.hpp"
#include "support/simple_building.hpp"

#include <cmath>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

Building two_zones() {
    Building building = test::simple_building();
    building.zones.push_back(test::simple_zone("hall"));
    building.boundaries.push_back({"ground", {10, 0, -1}});
    building.zones[0].couplings = {{1, {5, 0, -1}, {}}};
    return building;
}

Parameter parameter(const Building& building, const char* path,
                    Effect effect = Effect::replace) {
    Parameter p;
    p.name = path;
    p.effect = effect;
    p.targets = resolve(building, path);
    p.nominal = effect == Effect::factor ? 1 : 0;
    return p;
}

std::string refusal(const char* path) {
    try {
        resolve(two_zones(), path);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

/// Every default of the table is the one that the struct has.
TEST(Fields, StateTheDefaultsOfTheStructs) {
    Building building = test::simple_building();
    building.constructions[0] = {};
    building.glazings[0] = {};
    building.boundaries.push_back({});
    Zone& zone = building.zones[0] = {};
    zone.surfaces.resize(1);
    zone.windows.resize(1);
    zone.flows.resize(1);
    zone.loads.resize(1);
    zone.couplings.resize(1);
    building.air_systems.resize(1);
    building.constructions[0].layers.resize(1);
    Radiator& radiator = zone.radiator.emplace().radiator;
    radiator.power_60 = radiator.capacity = radiator.most_flow = 0;  // a job gives them
    for (std::size_t k = 0; k < fields().size(); ++k) {
        const Field& field = fields()[k];
        Target target;
        target.part = field.part;
        target.field = static_cast<int>(k);
        const double value = number_at(building, target);
        if (std::isnan(field.fallback))
            EXPECT_EQ(value, 0) << field.key;
        else
            EXPECT_EQ(value, field.fallback) << field.key;
    }
}

TEST(Fields, AreCompleteAndOnlyOnce) {
    std::set<std::string> seen;
    for (const Field& field : fields()) {
        const std::string path = std::string(name_of(field.part)) + "." + field.key;
        EXPECT_TRUE(seen.insert(path).second) << path;
        EXPECT_NE(field.input == nullptr, field.constant == nullptr) << path;
        EXPECT_LT(field.least, field.most) << path;
        EXPECT_GT(std::string(field.sentence).size(), 10u) << path;
        if (!std::isnan(field.fallback)) {
            EXPECT_GE(field.fallback, field.least) << path;
            EXPECT_LE(field.fallback, field.most) << path;
        }
    }
}

/// Each row leads to a number of its own.
TEST(Fields, LeadToDifferentNumbers) {
    Building building = two_zones();
    building.constructions[0].layers.resize(1);
    building.air_systems.resize(1);
    building.zones[0].radiator.emplace();
    std::set<double*> places;
    for (std::size_t k = 0; k < fields().size(); ++k) {
        Target target;
        target.part = fields()[k].part;
        target.field = static_cast<int>(k);
        EXPECT_TRUE(places.insert(&number_at(building, target)).second)
            << fields()[k].key;
    }
}

TEST(Resolve, FindsEveryKindOfPart) {
    Building b = two_zones();
    const auto at = [&b](const char* path) -> double& {
        const std::vector<Target> targets = resolve(b, path);
        EXPECT_EQ(targets.size(), 1u) << path;
        return number_at(b, targets.at(0));
    };
    Zone& room = b.zones[0];
    EXPECT_EQ(&at("construction.wall.u_value"), &b.constructions[0].u_value.value);
    EXPECT_EQ(&at("glazing.double.frame_fraction"), &b.glazings[0].frame_fraction);
    EXPECT_EQ(&at("boundary.ground.temperature"), &b.boundaries[0].temperature.value);
    EXPECT_EQ(&at("zone.hall.floor_area"), &b.zones[1].floor_area);
    EXPECT_EQ(&at("zone.room.heating_set_point"),
              &room.thermostat.heating_set_point.value);
    EXPECT_EQ(&at("zone.room.heating_set_point.low"),
              &room.thermostat.heating_set_point.low);
    EXPECT_EQ(&at("zone.room.air_capacity"), &room.structure.air_capacity);
    EXPECT_EQ(&at("zone.room.surface.wall.area"), &room.surfaces[0].area);
    EXPECT_EQ(&at("zone.room.window.south.shading_factor"),
              &room.windows[0].shading.value);
    EXPECT_EQ(&at("zone.room.flow.infiltration.air_change"),
              &room.flows[0].air_change.value);
    EXPECT_EQ(&at("zone.room.load.equipment.density"), &room.loads[0].density.value);
    EXPECT_EQ(&at("zone.room.coupling.hall.conductance"),
              &room.couplings[0].conductance.value);
    EXPECT_EQ(&at("plant.cooling_cop"), &b.plant.cooling_cop.value);
    EXPECT_EQ(&at("zone.room.venting_air_change"), &room.venting.air_change.value);
    EXPECT_EQ(&at("zone.room.venting_opens_above"), &room.venting.opens_above);
    EXPECT_EQ(&at("zone.room.supply_shift"), &room.outdoor_shift.supply.value);
    EXPECT_EQ(&at("meter.electricity.factor"), &b.meter_factor[3].value);
}

TEST(Resolve, TakesAStarForEveryName) {
    const Building b = two_zones();
    EXPECT_EQ(resolve(b, "zone.*.volume").size(), 2u);
    EXPECT_EQ(resolve(b, "zone.*.load.*.density").size(), 2u);
    EXPECT_EQ(resolve(b, "construction.*.u_value.low").size(), 1u);
    EXPECT_EQ(resolve(b, "zone.*.coupling.hall.air_flow").size(), 1u);
}

TEST(Resolve, SaysWhatWouldHaveMatched) {
    EXPECT_EQ(refusal("zone.rom.volume"),
              "zone.rom.volume: there is no \"rom\" after zone; expected hall, room");
    EXPECT_NE(refusal("zones.room.volume").find("no \"zones\" at its start"),
              std::string::npos);
    EXPECT_NE(refusal("zones.room.volume").find("boundary, construction"),
              std::string::npos);
    EXPECT_NE(refusal("plant.cop").find("cooling_cop, cooling_cycling_loss"),
              std::string::npos);
    EXPECT_NE(refusal("zone.room.load.equipment").find("not complete"),
              std::string::npos);
    EXPECT_NE(
        refusal("zone.room.volume.high").find("nothing may stand after zone.room.volume"),
        std::string::npos);
    EXPECT_NE(refusal("zone.room.volume.low").find("no low"), std::string::npos);
    EXPECT_NE(refusal("meter.air_temperature.factor").find("cooling, district"),
              std::string::npos);
    EXPECT_NE(refusal("plant.*").find("no \"*\""), std::string::npos);
    EXPECT_NE(refusal("zone.room.*").find("no \"*\""), std::string::npos);
    EXPECT_NE(refusal(""), "");
    EXPECT_NE(refusal("..."), "");
}

TEST(Apply, ReplacesMultipliesAndShifts) {
    const Building nominal = two_zones();
    const std::vector<Parameter> parameters = {
        parameter(nominal, "construction.wall.u_value", Effect::factor),
        parameter(nominal, "zone.*.heating_set_point", Effect::offset),
        parameter(nominal, "plant.cooling_cop")};
    Building point = nominal;
    for (int repeat = 0; repeat < 2; ++repeat) {  // twice gives the same as once
        apply(nominal, parameters, std::vector<double>{1.5, -2, 4}, point);
        EXPECT_DOUBLE_EQ(point.constructions[0].u_value.value, 0.6);
        EXPECT_EQ(point.zones[0].thermostat.heating_set_point.value, 18);
        EXPECT_EQ(point.zones[1].thermostat.heating_set_point.value, 18);
        EXPECT_EQ(point.plant.cooling_cop.value, 4);
    }
    EXPECT_EQ(point.zones[0].volume, nominal.zones[0].volume);
}

// A building may be nominal at another value than its description's.
TEST(Apply, FactorsAndOffsetsAreOfTheDescription) {
    const Building described = two_zones();
    std::vector<Parameter> parameters = {
        parameter(described, "construction.wall.u_value", Effect::factor),
        parameter(described, "zone.room.heating_set_point", Effect::offset)};
    Building nominal = described, once = described, twice = described;
    apply(described, parameters, std::vector<double>{0.8, 2}, once);
    set_nominal(1.5, parameters[0], nominal);
    set_nominal(-1, parameters[1], nominal);
    EXPECT_DOUBLE_EQ(nominal.constructions[0].u_value.value, 0.6);
    EXPECT_DOUBLE_EQ(nominal.zones[0].thermostat.heating_set_point.value, 19);
    apply(nominal, parameters, std::vector<double>{0.8, 2}, twice);
    EXPECT_DOUBLE_EQ(twice.constructions[0].u_value.value,
                     once.constructions[0].u_value.value);
    EXPECT_DOUBLE_EQ(twice.zones[0].thermostat.heating_set_point.value, 22);
}

TEST(SetNominal, OfAFactorOfZeroLeavesSomethingToChange) {
    Building building = two_zones();
    const double u = building.constructions[0].u_value.value;
    Parameter factor = parameter(building, "construction.wall.u_value", Effect::factor);
    set_nominal(0, factor, building);
    EXPECT_NEAR(building.constructions[0].u_value.value, 0, 1e-8);
    Building point = building;
    apply(building, {&factor, 1}, std::vector<double>{1.0}, point);
    EXPECT_DOUBLE_EQ(point.constructions[0].u_value.value, u);
}

TEST(Resolve, TakesThePathOfANumber) {
    const Building building = two_zones();
    for (const char* path :
         {"construction.wall.u_value", "zone.hall.volume", "plant.cooling_cop",
          "boundary.ground.temperature", "zone.room.heating_set_point.low"})
        EXPECT_EQ(path_of(building, resolve(building, path)[0]), path);
}

TEST(Apply, ChangesTheLowOfAnInputAlone) {
    const Building nominal = two_zones();
    Building point = nominal;
    apply(nominal, std::vector{parameter(nominal, "zone.room.heating_set_point.low")},
          std::vector<double>{15}, point);
    EXPECT_EQ(point.zones[0].thermostat.heating_set_point.low, 15);
    EXPECT_EQ(point.zones[0].thermostat.heating_set_point.value, 20);
}

}  // namespace
}  // namespace bemcal::physics
