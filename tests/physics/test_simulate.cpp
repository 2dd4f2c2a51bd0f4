/// A period step by step, against a published year and against the hour's own functions.
#include "physics/simulate.hpp"
#include "support/csv_table.hpp"
#include "support/measured.hpp"
#include "support/simple_building.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

TEST(Simulate, IsTheStandardsHourBitForBit) {
    const Building building = test::simple_building();
    const Drive drive = test::swinging_drive(building, 500, 8, 500);
    const ZoneTrajectory zone = simulate(building, drive).zones[0];
    double theta_m = 20;
    Network network;
    for (int step = 0; step < 500; ++step) {
        make_network(building, building.zones[0], drive, step, network);
        const HourDrive hour =
            hour_drive(building, building.zones[0], network, drive, step);
        const NodeGains gains = split_gains(network, hour.phi_int, hour.phi_sol);
        const Control control = control_at(building.zones[0], drive, step);
        const double phi = power_for_set_point(network, hour, gains, control, theta_m);
        const NodeTemperatures theta = advance_hour(network, hour, gains, theta_m, phi);
        theta_m = theta.theta_m_t;
        const auto k = static_cast<std::size_t>(step);
        ASSERT_EQ(zone.theta_m[k], theta.theta_m_t);
        ASSERT_EQ(zone.theta_air[k], theta.theta_air);
        ASSERT_EQ(zone.theta_op[k], theta.theta_op);
        ASSERT_EQ(zone.heating[k] - zone.cooling[k], phi);
    }
}

TEST(Simulate, LeavesTheWarmUpOut) {
    const Building building = test::simple_building();
    Drive drive = test::swinging_drive(building, 100, 8, 500);
    const ZoneTrajectory all = simulate(building, drive).zones[0];
    drive.n_warm_up = 40;
    const ZoneTrajectory period = simulate(building, drive).zones[0];
    ASSERT_EQ(period.theta_air.size(), 60u);
    EXPECT_EQ(period.theta_air[0], all.theta_air[40]);
    EXPECT_EQ(period.heating[59], all.heating[99]);
}

TEST(Simulate, ForgetsItsStartInTheWarmUp) {
    const Building building = test::simple_building();
    Drive drive = test::swinging_drive(building, 3000, 8, 500);
    drive.n_warm_up = 2900;
    drive.theta_start = 0;
    const double cold = simulate(building, drive).zones[0].theta_m[0];
    drive.theta_start = 35;
    const double warm = simulate(building, drive).zones[0].theta_m[0];
    EXPECT_NEAR(cold, warm, 1e-9);
}

/// RC_BuildingSimulator's zone of the annual file. Its H_tr_em is U A itself, so the
/// U-value is chosen that eq. 63 gives 0.2 W/(m2 K) x 11 m2; gains come as columns.
Building zurich() {
    Building building = test::simple_building();
    Zone& zone = building.zones[0];
    zone.floor_area = 35;
    zone.volume = 105;
    zone.surface_area_ratio = 142.0 / 35;
    zone.sky_temperature_difference = 0;
    const double H_tr_ms = 9.1 * 2.5 * 35, H_tr_op = 1 / (1 / (0.2 * 11) + 1 / H_tr_ms);
    building.constructions[0].u_value.value = H_tr_op / 11;
    zone.surfaces[0].area = 11;
    zone.surfaces[0].in_sun = false;
    building.glazings[0].u_value.value = 1.1;
    building.glazings[0].solar_transmittance.value = 0.25;  // an aperture of 1 m2
    building.glazings[0].incidence_factor = 1;
    building.glazings[0].frame_fraction = 0;
    zone.windows[0].area = 4;
    zone.flows[0].air_change.value = 1.5 + 0.5;
    zone.flows[0].heat_recovery.value = 1.5 / 2 * 0.6;
    zone.loads[0].density = {1.0 / 35, 0, 0};
    return building;
}

TEST(Simulate, GivesThePublishedYearHourByHour) {
    const auto file = test::shared_file("thermal/rcsim_annual_zurich.csv");
    if (test::is_absent(file)) GTEST_SKIP() << file;
    const test::CsvTable table(file);
    ASSERT_EQ(table.n_rows(), 8760u);
    const Building building = zurich();
    Drive drive = test::constant_drive(building, 8760, 0, 0, 3600, 1);
    for (std::size_t hour = 0; hour < 8760; ++hour) {
        drive.theta_e[hour] = table.number(hour, "t_out_C");
        drive.irradiance(0, hour) = table.number(hour, "solar_gains_W");
        drive.profiles(0, hour) = table.number(hour, "internal_gains_W");
    }
    const ZoneTrajectory zone = simulate(building, drive).zones[0];
    double power = 0, temperature = 0;
    for (std::size_t hour = 0; hour < 8760; ++hour) {
        const double cooling = std::abs(table.number(hour, "cooling_W"));
        power = std::max({power,
                          std::abs(zone.heating[hour] - table.number(hour, "heating_W")),
                          std::abs(zone.cooling[hour] - cooling)});
        temperature = std::max(
            {temperature, std::abs(zone.theta_m[hour] - table.number(hour, "t_m_next")),
             std::abs(zone.theta_air[hour] - table.number(hour, "t_air"))});
    }
    test::print_measured("a published year, largest error of an hour's power", power, "W",
                         "1e-6");
    test::print_measured("a published year, largest error of an hour's temperature",
                         temperature, "K", "1e-9");
    EXPECT_LE(power, 1e-6);
    EXPECT_LE(temperature, 1e-9);
}

Building two_zones() {
    Building building = test::simple_building();
    building.zones.push_back(test::simple_zone("hall"));
    for (Zone& zone : building.zones)
        zone.thermostat.heating_capacity.value = zone.thermostat.cooling_capacity.value =
            0;
    return building;
}

TEST(Simulate, KeepsUncoupledZonesApart) {
    Building building = two_zones();
    building.zones[1].loads[0].density.value = 50;
    const Drive drive = test::swinging_drive(building, 200, 8, 500);
    const Trajectory both = simulate(building, drive);
    building.zones.pop_back();
    EXPECT_EQ(simulate(building, drive).zones[0].theta_air, both.zones[0].theta_air);
}

TEST(Simulate, CouplesTwinsWithoutEffect) {
    Building building = two_zones();
    const Drive drive = test::constant_drive(building, 4000, 8);
    const double alone = simulate(building, drive).zones[0].theta_air.back();
    building.zones[0].couplings = {{1, {30, 0, -1}, {}}};
    EXPECT_NEAR(simulate(building, drive).zones[0].theta_air.back(), alone, 1e-9);
    EXPECT_NEAR(simulate(building, drive).zones[1].theta_air.back(), alone, 1e-9);
}

/// In the steady state what a conductance takes from one zone's air it gives to the
/// other's: the losses of both together equal the gains of both.
TEST(Simulate, BalancesACouplingBetweenBothZones) {
    Building building = two_zones();
    building.zones[0].loads[0].density.value = 40;
    building.zones[0].couplings = {{1, {25, 0, -1}, {}}};
    const Drive drive = test::constant_drive(building, 6000, 0);
    const Trajectory t = simulate(building, drive);
    double lost = 0, gained = 0;
    Network n;
    for (std::size_t zone = 0; zone < 2; ++zone) {
        make_network(building, building.zones[zone], drive, 0, n);
        const HourDrive hour = hour_drive(building, building.zones[zone], n, drive, 0);
        const NodeGains gains = split_gains(n, hour.phi_int, hour.phi_sol);
        gained += gains.phi_ia + gains.phi_st + gains.phi_m;
        const double theta_air = t.zones[zone].theta_air.back();
        const double theta_s = (t.zones[zone].theta_op.back() - 0.3 * theta_air) / 0.7;
        lost += n.H_ve * theta_air + n.H_tr_w * theta_s +
                n.H_tr_em * t.zones[zone].theta_m.back();
    }
    EXPECT_NEAR(lost, gained, 1e-9 * gained);
    EXPECT_GT(t.zones[1].theta_air.back(),
              simulate(two_zones(), drive).zones[1].theta_air.back() + 1);
}

TEST(Simulate, TakesAirFromTheOtherZoneOneWay) {
    Building building = two_zones();
    building.zones[0].loads[0].density.value = 40;
    const Drive drive = test::constant_drive(building, 1000, 0);
    const Trajectory apart = simulate(building, drive);
    building.zones[1].couplings = {{0, {}, {100, 0, -1}}};
    const Trajectory coupled = simulate(building, drive);
    EXPECT_EQ(coupled.zones[0].theta_air, apart.zones[0].theta_air);
    EXPECT_GT(coupled.zones[1].theta_air.back(), apart.zones[1].theta_air.back() + 1);
}

/// In the steady state 100 m3/h from the other zone are 2 air changes with its air as
/// supply.
TEST(Simulate, TakesAsMuchHeatFromTheOtherZoneAsFromASupply) {
    Building building = two_zones();
    building.zones[0].loads[0].density.value = 40;
    building.zones[1].couplings = {{0, {}, {100, 0, -1}}};
    const Drive drive = test::constant_drive(building, 6000, 0);
    const Trajectory coupled = simulate(building, drive);
    building.zones[1].couplings.clear();
    building.boundaries.push_back({"room", {coupled.zones[0].theta_air.back(), 0, -1}});
    AirFlow supply;
    supply.air_change.value = 2;
    supply.supply = 0;
    building.zones[1].flows.push_back(supply);
    EXPECT_NEAR(simulate(building, drive).zones[1].theta_air.back(),
                coupled.zones[1].theta_air.back(), 1e-9);
}

TEST(Simulate, RefusesACouplingThatMakesTheMassRing) {
    Building building = two_zones();
    building.zones[1].heat_capacity = 9000;
    const Drive drive = test::constant_drive(building, 2, 0);
    EXPECT_NO_THROW(simulate(building, drive));
    building.zones[0].couplings = {{1, {1000, 0, -1}, {}}};
    EXPECT_THROW(simulate(building, drive), std::domain_error);
}

TEST(Simulate, RefusesACouplingAboveWhatTiesTheAirToItsSurfaces) {
    Building building = two_zones();
    const Drive drive = test::constant_drive(building, 2, 0);
    double H_tr_is = std::numeric_limits<double>::infinity();
    for (const Zone& zone : building.zones) {
        Network network;
        make_network(building, zone, drive, 0, network);
        H_tr_is = std::min(H_tr_is, network.H_tr_is);
    }
    building.zones[0].couplings = {{1, {0.999 * H_tr_is, 0, -1}, {}}};
    EXPECT_NO_THROW(simulate(building, drive));
    building.zones[0].couplings = {{1, {1.001 * H_tr_is, 0, -1}, {}}};
    EXPECT_THROW(simulate(building, drive), std::domain_error);
}

TEST(Simulate, RefusesANegativeCoupling) {
    Building building = two_zones();
    building.zones[0].couplings = {{1, {-3, 0, -1}, {}}};
    const Drive drive = test::constant_drive(building, 2, 0);
    EXPECT_THROW(simulate(building, drive), std::domain_error);
}

TEST(Simulate, NamesZoneAndStepOfWhatIsNotFinite) {
    Building building = test::simple_building();
    Drive drive = test::constant_drive(building, 20, 8);
    drive.theta_e[7] = std::nan("");
    try {
        simulate(building, drive);
        FAIL();
    } catch (const std::domain_error& error) {
        EXPECT_NE(std::string(error.what()).find("zone room, step 7"), std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace bemcal::physics
