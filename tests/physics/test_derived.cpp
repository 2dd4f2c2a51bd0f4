/// Numbers that follow from others: published examples, and the same numbers by hand.
#include "kernel/response.hpp"
#include "physics/derived.hpp"
#include "physics/parameters.hpp"
#include "support/simple_building.hpp"

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// From outside: plaster, insulation, brick, plaster.
Construction insulated_wall() {
    Construction wall;
    wall.name = "wall";
    wall.layers = {{"render", 0.02, 0.87, 1800, 1000},
                   {"insulation", 0.10, 0.04, 30, 1400},
                   {"brick", 0.24, 0.80, 1840, 900},
                   {"plaster", 0.015, 0.70, 1400, 1000}};
    return wall;
}

/// The room with its wall in layers and paper 2's density as a parameter's target.
Building layered() {
    Building building = test::simple_building();
    building.constructions[0] = insulated_wall();
    Link link;
    link.targets = resolve(building, "construction.wall.layer.brick.conductivity");
    link.sources = resolve(building, "construction.wall.layer.brick.density");
    link.terms = {{-0.12, {0}}, {0.0005, {1}}};
    building.links = {link};
    return building;
}

Parameter parameter(const Building& building, const char* path) {
    Parameter p;
    p.name = path;
    p.targets = resolve(building, path);
    return p;
}

TEST(Derived, UValueIsThatOfResistancesInARow) {
    const double resistance =
        0.04 + 0.02 / 0.87 + 0.10 / 0.04 + 0.24 / 0.80 + 0.015 / 0.70 + 0.13;
    EXPECT_NEAR(u_value_of(insulated_wall()), 1 / resistance, 1e-15);
}

/// 0.1 m from inside: all of the plaster, the rest brick.
TEST(Derived, CapacityIsThatOfTheInnerTenCentimetres) {
    EXPECT_NEAR(areal_capacity(insulated_wall()),
                0.015 * 1400 * 1000 + 0.085 * 1840 * 900, 1e-9);
}

/// ISO 13786's other two ends: the first insulation, and half of the construction.
TEST(Derived, CapacityEndsAtInsulationAndInTheMiddle) {
    Construction inside_out = insulated_wall();
    std::swap(inside_out.layers.front(), inside_out.layers.back());
    std::swap(inside_out.layers[1], inside_out.layers[2]);
    EXPECT_NEAR(areal_capacity(inside_out), 0.02 * 1800 * 1000, 1e-9);
    Construction partition;
    partition.layers = {{"brick", 0.12, 0.80, 1840, 900}};
    EXPECT_NEAR(areal_capacity(partition), 0.06 * 1840 * 900, 1e-9);
}

/// Paper 2's Table 2: 1614 kg/m3 go with 0.687 W/(m K), 2146 with 0.953.
TEST(Derived, ConductivityFollowsDensityAsInPaper2) {
    const Building nominal = layered();
    const Parameter density = parameter(nominal, "construction.wall.layer.brick.density");
    Building building = nominal;
    for (const auto& [rho, lambda] : {std::pair{1614.0, 0.687}, {2146.0, 0.953}}) {
        apply(nominal, {&density, 1}, {&rho, 1}, building);
        EXPECT_NEAR(building.constructions[0].layers[2].conductivity, lambda, 5e-4);
        EXPECT_EQ(building.constructions[0].u_value.value,
                  u_value_of(building.constructions[0]));
    }
}

TEST(Derived, ApplyForgetsThePointBefore) {
    const Building nominal = layered();
    const Parameter density = parameter(nominal, "construction.wall.layer.brick.density");
    Building one = nominal, other = nominal;
    const double far = 2100, here = 1700;
    apply(nominal, {&density, 1}, {&far, 1}, one);
    for (Building* building : {&one, &other})
        apply(nominal, {&density, 1}, {&here, 1}, *building);
    EXPECT_EQ(one.constructions[0].u_value.value, other.constructions[0].u_value.value);
}

TEST(Derived, TableTakesTheRowOfTheNearestKey) {
    Building building = test::simple_building();
    Link link;
    link.targets = resolve(building, "glazing.double.u_value");
    link.targets.push_back(resolve(building, "glazing.double.solar_transmittance")[0]);
    link.sources = resolve(building, "glazing.double.type");
    link.rows = {{1, {2.8, 0.76}}, {2, {1.4, 0.6}}, {3, {0.7, 0.5}}};
    building.links = {link};
    building.glazings[0].type = 2;
    derive(building);
    EXPECT_EQ(building.glazings[0].u_value.value, 1.4);
    EXPECT_EQ(building.glazings[0].solar_transmittance.value, 0.6);
    building.glazings[0].type = 2.6;
    derive(building);
    EXPECT_EQ(building.glazings[0].u_value.value, 0.7);
}

/// psi = 0.02 + 0.1 lambda^2 + 0.3 lambda_1 lambda_2, times 10 m.
TEST(Derived, PolynomialOfSeveralNumbers) {
    Building building = layered();
    Link bridge;
    bridge.targets = resolve(building, "zone.room.bridge_conductance");
    bridge.sources = {
        resolve(building, "construction.wall.layer.brick.conductivity")[0],
        resolve(building, "construction.wall.layer.render.conductivity")[0]};
    bridge.terms = {{0.2, {0, 0}}, {1, {2, 0}}, {3, {1, 1}}};
    building.links.push_back(bridge);
    derive(building);
    const double lambda = 0.0005 * 1840 - 0.12;
    EXPECT_NEAR(building.zones[0].bridge_conductance,
                0.2 + lambda * lambda + 3 * lambda * 0.87, 1e-12);
}

/// ISO 13790, 12.2.2: one construction everywhere has A_m = A; a massless second one
/// leaves it so.
TEST(Derived, MassAreaIsThatOfTheHeavySurfaces) {
    Building building = layered();
    Zone& zone = building.zones[0];
    zone.capacity_of_layers = true;
    building.constructions.push_back({});
    building.constructions[1].name = "board";
    building.constructions[1].layers = {{"board", 0.02, 0.05, 20, 1000}};
    Surface light = zone.surfaces[0];
    light.name = "light";
    light.construction = 1;
    zone.surfaces.push_back(light);
    derive(building);
    EXPECT_NEAR(zone.mass_area_ratio * zone.floor_area, zone.surfaces[0].area, 1e-9);
    EXPECT_NEAR(zone.heat_capacity * zone.floor_area,
                areal_capacity(building.constructions[0]) * zone.surfaces[0].area, 1e-6);
}

TEST(Derived, KnowsWhatFollows) {
    const Building building = layered();
    const auto follows = [&](const char* path) {
        return is_derived(building, resolve(building, path)[0]);
    };
    EXPECT_TRUE(follows("construction.wall.u_value"));
    EXPECT_TRUE(follows("construction.wall.layer.brick.conductivity"));
    EXPECT_FALSE(follows("construction.wall.layer.brick.density"));
    EXPECT_FALSE(follows("zone.room.heat_capacity"));
    EXPECT_FALSE(kernel::has_derivatives(building));
    EXPECT_TRUE(kernel::has_derivatives(test::simple_building()));
}

}  // namespace
}  // namespace bemcal::physics
