/// A zone heated by a radiator: against a power that is imposed, against itself at
/// shorter steps, and the same through the batch.
#include "kernel/batch.hpp"
#include "kernel/plain_answer.hpp"
#include "kernel/response.hpp"
#include "support/simple_building.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// The simple room without cooling, with a radiator that is always on at 60 degC.
Building heated_room() {
    Building building = test::simple_building();
    Zone& zone = building.zones[0];
    zone.thermostat.cooling_capacity.value = 0;
    zone.structure.air_capacity = 20000;
    ZoneRadiator& radiator = zone.radiator.emplace();
    radiator.radiator.power_60 = 1500;
    radiator.radiator.n_elements = 2;
    radiator.measured.value = 1;
    radiator.supply_temperature.value = 60;
    return building;
}

double mean(const std::vector<double>& values, std::size_t from) {
    double sum = 0;
    for (std::size_t k = from; k < values.size(); ++k) sum += values[k];
    return sum / static_cast<double>(values.size() - from);
}

/// In a steady state the room gets what the water loses, so that a power imposed at the
/// air node holds the same temperature where the radiator does not radiate.
TEST(ZoneRadiator, HeatsAsTheSamePowerImposed) {
    Building building = heated_room();
    building.zones[0].radiator->radiator.radiative_fraction = 0;
    const Drive drive = test::constant_drive(building, 1200, 0);
    const ZoneTrajectory radiator = simulate(building, drive).zones[0];
    const double power = radiator.heating.back();
    EXPECT_GT(power, 500);
    building.zones[0].radiator.reset();
    building.zones[0].thermostat.imposed = true;
    building.zones[0].thermostat.imposed_power.value =
        power / building.zones[0].floor_area;
    const ZoneTrajectory imposed = simulate(building, drive).zones[0];
    EXPECT_NEAR(radiator.theta_air.back(), imposed.theta_air.back(), 1e-6);
    EXPECT_NEAR(radiator.theta_m.back(), imposed.theta_m.back(), 1e-6);
}

/// EN 442's law: in a steady state with much water the heat is that at 60 K, times the
/// power of the ratio.
TEST(ZoneRadiator, GivesItsNominalPowerAtSixtyKelvin) {
    Building building = heated_room();
    ZoneRadiator& radiator = *building.zones[0].radiator;
    radiator.radiator.most_flow = 0.5;
    radiator.radiator.radiative_fraction = 0;
    const Drive drive = test::constant_drive(building, 1200, 0);
    const ZoneTrajectory zone = simulate(building, drive).zones[0];
    const double above = 60 - zone.theta_air.back();
    EXPECT_NEAR(zone.heating.back(), 1500 * std::pow(above / 60, 1.3), 12);
}

TEST(ZoneRadiator, HourlyStepsAreNearTenMinutes) {
    Building building = heated_room();
    ZoneRadiator& radiator = *building.zones[0].radiator;
    radiator.measured.value = 0;
    const Drive hours = test::swinging_drive(building, 24 * 30, 2, 200),
                short_steps = test::swinging_drive(building, 24 * 180, 2, 200, 600);
    const ZoneTrajectory coarse = simulate(building, hours).zones[0],
                         fine = simulate(building, short_steps).zones[0];
    EXPECT_NEAR(mean(coarse.theta_air, 480), mean(fine.theta_air, 2880), 0.05);
    EXPECT_NEAR(mean(coarse.heating, 480) / mean(fine.heating, 2880), 1, 0.005);
}

/// The curve of paper 2 and the same temperatures as a measured column.
TEST(ZoneRadiator, MeasuredSupplyOfTheCurveIsTheCurve) {
    Building building = heated_room();
    ZoneRadiator& radiator = *building.zones[0].radiator;
    Drive drive = test::swinging_drive(building, 24 * 14, 8, 200);
    drive.profiles = Matrix(1, drive.theta_e.size());
    for (std::size_t k = 0; k < drive.theta_e.size(); ++k)
        drive.profiles(0, k) =
            *supply_temperature(radiator.curve, true, drive.theta_e[k], 20);
    radiator.measured.value = 0;
    const ZoneTrajectory curve = simulate(building, drive).zones[0];
    radiator.measured.value = 1;
    radiator.supply_temperature = {1, 0, 0};
    const ZoneTrajectory measured = simulate(building, drive).zones[0];
    EXPECT_EQ(curve.theta_air, measured.theta_air);
    EXPECT_EQ(curve.heating, measured.heating);
}

TEST(ZoneRadiator, IsSetBackToDBelowFourteenDegrees) {
    Building building = heated_room();
    ZoneRadiator& radiator = *building.zones[0].radiator;
    radiator.measured.value = 0;
    radiator.scheduled.value = 0;
    radiator.curve.d = 70;
    const Drive drive = test::constant_drive(building, 24 * 30, -5);
    const ZoneTrajectory zone = simulate(building, drive).zones[0];
    double last = 20;
    for (std::size_t k = 0; k < zone.theta_air.size(); ++k) {
        EXPECT_EQ(zone.heating[k] > 0, last < 14) << k;
        last = zone.theta_air[k];
    }
    EXPECT_NEAR(mean(zone.theta_air, 480), 14, 1);
}

TEST(ZoneRadiator, RunsPlainInTheBatch) {
    const Building building = heated_room();
    const Drive drive = test::swinging_drive(building, 24 * 31, 2, 200);
    Parameter power;
    power.name = "power";
    power.targets = resolve(building, "zone.room.radiator.nominal_power");
    power.least = 500;
    power.most = 3000;
    const kernel::Batch batch(building, {power}, drive);
    EXPECT_TRUE(kernel::runs_plain(building));
    EXPECT_FALSE(kernel::has_derivatives(building));
    Matrix points(3, 1);
    points.values = {500, 1500, 3000};
    kernel::Request request;
    request.annual = {Quantity::heating, Quantity::air_temperature};
    const std::vector<kernel::PointAnswer> answers = batch.evaluate(points, request);
    EXPECT_EQ(answers[1].annual, kernel::plain_answer(building, drive, request).annual);
    EXPECT_LT(answers[0].annual[1] + 1, answers[1].annual[1]);
    EXPECT_LT(answers[1].annual[0], answers[2].annual[0]);
}

TEST(ZoneRadiator, OfNoFlowIsRefused) {
    Building building = heated_room();
    building.zones[0].radiator->radiator.most_flow = 0;
    const Drive drive = test::constant_drive(building, 24, 0);
    EXPECT_THROW(simulate(building, drive), std::domain_error);
}

}  // namespace
}  // namespace bemcal::physics
