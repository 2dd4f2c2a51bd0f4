/// From words to ISO 13790's symbols: conductances, apertures and gains worked out by
/// hand.
#include "physics/network.hpp"
#include "support/simple_building.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

struct Case {
    Building building = test::simple_building();
    Drive drive = test::constant_drive(building, 1, 5, 100);
    Zone& zone() { return building.zones[0]; }
    Network network() {
        Network network;
        make_network(building, zone(), drive, 0, network);
        return network;
    }
    std::string refusal() {
        try {
            network();
        } catch (const std::domain_error& error) {
            return error.what();
        }
        return "";
    }
};

TEST(Network, FollowsTheStandardsAreasClassesAndFilms) {
    Case c;
    const Network n = c.network();
    EXPECT_DOUBLE_EQ(n.A_f, 20);
    EXPECT_DOUBLE_EQ(n.A_m, 50);
    EXPECT_DOUBLE_EQ(n.A_tot, 90);
    EXPECT_DOUBLE_EQ(n.C_m, 165000 * 20);
    EXPECT_DOUBLE_EQ(n.H_tr_is, 3.45 * 90);
    EXPECT_DOUBLE_EQ(n.H_tr_ms, 9.1 * 50);
    EXPECT_DOUBLE_EQ(n.H_tr_w, 1.5 * 4);
    EXPECT_DOUBLE_EQ(n.H_ve, 1200 * 0.5 * 50 / 3600);
    EXPECT_NEAR(n.H_tr_em, 1 / (1 / 12.0 - 1 / 455.0), 1e-12);  // eq. 63
}

TEST(Network, SeesSunThroughGlassAndOnWalls) {
    Case c;
    c.zone().windows[0].shading.value = 0.8;
    const double glazed = 0.8 * 0.9 * 0.6 * (1 - 0.2) * 4;  // eq. 44, 47
    const double opaque = 0.6 * 0.04 * 0.4 * 30;            // eq. 45
    EXPECT_NEAR(c.network().aperture[0], glazed + opaque, 1e-12);
}

TEST(Network, LosesLongWaveRadiationToTheSky) {
    Case c;
    const double per_area = 0.5 * 0.04 * 5 * 0.9 * 11;  // eq. 46, 51; vertical
    EXPECT_NEAR(c.network().phi_sky, per_area * (0.4 * 30 + 1.5 * 4), 1e-12);
    c.building.planes[0].tilt = 0;
    EXPECT_NEAR(c.network().phi_sky, 2 * per_area * (0.4 * 30 + 1.5 * 4), 1e-12);
    c.zone().sky_temperature_difference = 0;
    EXPECT_EQ(c.network().phi_sky, 0);
}

TEST(Network, LeavesTheSunOffWhatDoesNotFaceIt) {
    Case c;
    const double before = c.network().aperture[0];
    c.zone().surfaces[0].in_sun = false;
    EXPECT_NEAR(before - c.network().aperture[0], 0.6 * 0.04 * 0.4 * 30, 1e-12);
    c.zone().surfaces[0].in_sun = true;
    c.building.boundaries.push_back({"ground", {10, 0, -1}});
    c.zone().surfaces[0].boundary = 0;
    EXPECT_NEAR(before - c.network().aperture[0], 0.6 * 0.04 * 0.4 * 30, 1e-12);
}

TEST(Network, SharesTransmissionAmongBoundaries) {
    Case c;
    c.building.boundaries.push_back({"ground", {12, 0, -1}});
    Surface floor = c.zone().surfaces[0];
    floor.area = 20;
    floor.boundary = 0;
    floor.adjustment = 0.5;
    c.zone().surfaces.push_back(floor);
    c.zone().bridge_conductance = 2;
    const Network n = c.network();  // outdoors 12 + 2, ground 4 W/K
    EXPECT_NEAR(n.em_share[0], 14.0 / 18, 1e-15);
    EXPECT_NEAR(n.em_share[1], 4.0 / 18, 1e-15);
    EXPECT_NEAR(n.H_tr_em, 1 / (1 / 18.0 - 1 / 455.0), 1e-12);
    const HourDrive hour = hour_drive(c.building, c.zone(), n, c.drive, 0);
    EXPECT_NEAR(hour.theta_em, (14 * 5 + 4 * 12) / 18.0, 1e-13);
    EXPECT_EQ(hour.theta_e, 5);
}

TEST(Network, RecoversHeatOnlyFromOutdoorAir) {
    Case c;
    c.building.boundaries.push_back({"supply", {18, 0, -1}});
    AirFlow ventilation;
    ventilation.air_change.value = 1.5;
    ventilation.heat_recovery.value = 0.6;
    c.zone().flows.push_back(ventilation);  // 0.5 + 1.5 * 0.4 = 1.1 1/h
    const double per_change = 1200 * 50 / 3600.0;
    EXPECT_NEAR(c.network().H_ve, 1.1 * per_change, 1e-12);
    c.zone().flows[1].supply = 0;
    const Network n = c.network();  // b_ve = 1 with a supply temperature of its own
    EXPECT_NEAR(n.H_ve, 2 * per_change, 1e-12);
    EXPECT_NEAR(hour_drive(c.building, c.zone(), n, c.drive, 0).theta_sup,
                0.25 * 5 + 0.75 * 18, 1e-12);
}

TEST(Network, AddsGainsOfLoadsAndSun) {
    Case c;
    Load water;
    water.density.value = 3;
    water.heat_fraction = 0.25;
    c.zone().loads.push_back(water);
    const Network n = c.network();
    const HourDrive hour = hour_drive(c.building, c.zone(), n, c.drive, 0);
    EXPECT_NEAR(hour.phi_int, 20 * (5 + 0.75), 1e-12);
    EXPECT_NEAR(hour.phi_sol, 100 * n.aperture[0] - n.phi_sky, 1e-12);
}

TEST(Network, FollowsProfiles) {
    Case c;
    c.drive = test::constant_drive(c.building, 2, 5, 0, 3600, 1);
    c.drive.profiles(0, 1) = 1;
    c.zone().flows[0].air_change = {2, 0.5, 0};
    c.zone().thermostat.heating_set_point = {21, 15, 0};
    c.zone().thermostat.heating_available = {1, 0, 0};
    Network n;
    make_network(c.building, c.zone(), c.drive, 0, n);
    EXPECT_NEAR(n.H_ve, 1200 * 0.5 * 50 / 3600, 1e-12);
    make_network(c.building, c.zone(), c.drive, 1, n);
    EXPECT_NEAR(n.H_ve, 1200 * 2 * 50 / 3600.0, 1e-12);
    EXPECT_EQ(control_at(c.zone(), c.drive, 0).theta_H_set, 15);
    EXPECT_EQ(control_at(c.zone(), c.drive, 0).phi_H_max, 0);
    EXPECT_EQ(control_at(c.zone(), c.drive, 1).theta_H_set, 21);
    EXPECT_EQ(control_at(c.zone(), c.drive, 1).phi_H_max, unlimited);
}

TEST(Network, ScalesCapacitiesAndImposedPowerByTheFloor) {
    Case c;
    c.zone().thermostat.heating_capacity.value = 40;
    EXPECT_EQ(control_at(c.zone(), c.drive, 0).phi_H_max, 800);
    c.zone().thermostat.heating_available.value = 0.25;
    EXPECT_EQ(control_at(c.zone(), c.drive, 0).phi_H_max, 200);
    c.zone().thermostat.imposed = true;
    c.zone().thermostat.imposed_power.value = -7;
    EXPECT_TRUE(control_at(c.zone(), c.drive, 0).imposed);
    EXPECT_EQ(control_at(c.zone(), c.drive, 0).phi_imposed, -140);
}

TEST(Network, RefusesWallsThatLoseMoreThanTheMassCanPass) {
    Case c;
    c.building.constructions[0].u_value.value = 20;  // 600 W/K against 455 W/K
    EXPECT_NE(c.refusal().find("zone room"), std::string::npos);
    EXPECT_NE(c.refusal().find("H_tr_op = 600 W/K"), std::string::npos);
    EXPECT_NE(c.refusal().find("H_tr_ms = 455 W/K"), std::string::npos);
}

TEST(Network, RefusesAMassThatWouldRing) {
    Case c;
    c.zone().heat_capacity = 2000;
    EXPECT_NE(c.refusal().find("ring"), std::string::npos);
    EXPECT_NE(c.refusal().find("zone room"), std::string::npos);
    c.drive.axis.step_s = 600;
    EXPECT_EQ(c.refusal(), "");
}

TEST(Network, RefusesASecondMassThatWouldRing) {
    Case c;
    c.zone().structure.second_mass_conductance = 2;
    c.zone().structure.second_mass_capacity = 3000;
    EXPECT_NE(c.refusal().find("second mass"), std::string::npos);
    c.zone().structure.second_mass_capacity = 4000;
    EXPECT_EQ(c.refusal(), "");
}

TEST(Network, RefusesNegativeAndMissingNumbers) {
    const auto refused = [](auto change, const char* word) {
        Case c;
        change(c);
        return c.refusal().find(word) != std::string::npos;
    };
    const double nan = std::nan("");
    EXPECT_TRUE(refused([](Case& c) { c.zone().floor_area = 0; }, "floor_area"));
    EXPECT_TRUE(refused([&](Case& c) { c.zone().heat_capacity = nan; }, "heat_capacity"));
    EXPECT_TRUE(refused([](Case& c) { c.zone().windows[0].area = -1; }, "area"));
    EXPECT_TRUE(refused([](Case& c) { c.zone().surfaces[0].area = -1; }, "area"));
    EXPECT_TRUE(
        refused([](Case& c) { c.zone().flows[0].air_change.value = -1; }, "flow"));
    EXPECT_TRUE(
        refused([&](Case& c) { c.building.glazings[0].u_value.value = nan; }, "u_value"));
    EXPECT_TRUE(refused([](Case& c) { c.zone().bridge_conductance = -50; }, "H_tr_op"));
}

TEST(Network, RefusesCrossedSetPointsOnlyWhereBothWork) {
    Case c;
    c.zone().thermostat.heating_set_point.value = 27;
    EXPECT_THROW(control_at(c.zone(), c.drive, 0), std::domain_error);
    c.zone().thermostat.cooling_capacity.value = 0;
    EXPECT_NO_THROW(control_at(c.zone(), c.drive, 0));
}

TEST(Network, WhereAnEffectBringsSetPointsTogetherCoolingGivesWay) {
    Case c;
    c.drive = test::constant_drive(c.building, 2, 5, 0, 3600, 1);
    c.drive.profiles(0, 1) = 1;
    Thermostat& thermostat = c.zone().thermostat;
    c.zone().structure.proportional_band = 1.5;
    thermostat.heating_set_point.value = 21;
    thermostat.cooling_set_point.value = 24;
    thermostat.cooling_set_point.changes = {{-1.5, 0, ChangeKind::shift}};
    const auto control = [&] { return control_at(c.zone(), c.drive, 1); };
    EXPECT_EQ(control().theta_C_set, 22.5);  // just the band
    EXPECT_FALSE(control().held_apart);
    thermostat.cooling_set_point.changes[0].amount = -1.6;
    EXPECT_EQ(control().theta_C_set, 22.5);
    EXPECT_EQ(control().theta_H_set, 21);
    EXPECT_TRUE(control().held_apart);
    thermostat.cooling_set_point.changes[0].amount = std::nan("");
    EXPECT_THROW(control(), std::domain_error);
}

TEST(Network, EffectsThatWouldTakeMoreAirThanFlowsLeaveNone) {
    Case c;
    c.drive = test::constant_drive(c.building, 2, 5, 0, 3600, 1);
    c.drive.profiles(0, 1) = 1;
    ASSERT_EQ(c.zone().flows.size(), 1U);
    Input& air_change = c.zone().flows[0].air_change;
    air_change = {0.5, 0, -1};
    const auto H_ve = [&] {
        Network network;
        make_network(c.building, c.zone(), c.drive, 1, network);
        return network.H_ve;
    };
    air_change.changes = {{-0.4, 0, ChangeKind::shift}};
    EXPECT_NEAR(H_ve(), rho_c_air * 0.1 * c.zone().volume / 3600, 1e-9);
    air_change.changes[0].amount = -0.6;
    EXPECT_EQ(H_ve(), 0);
    air_change.changes[0].amount = std::nan("");
    EXPECT_THROW(H_ve(), std::domain_error);
    air_change = {-0.1, 0, -1};  // as described
    EXPECT_THROW(H_ve(), std::domain_error);
}

TEST(Network, RefusesSetPointsCloserThanTheBand) {
    Case c;
    c.zone().structure.proportional_band = 4;
    c.zone().thermostat.cooling_set_point.value = 23;
    EXPECT_THROW(control_at(c.zone(), c.drive, 0), std::domain_error);
    c.zone().thermostat.cooling_set_point.value = 24;
    EXPECT_NO_THROW(control_at(c.zone(), c.drive, 0));
}

}  // namespace
}  // namespace bemcal::physics
