/// Meters: the plant's conversion, loads by carrier, and the calendar's intervals.
#include "physics/interval_hours.hpp"
#include "physics/meters.hpp"
#include "support/simple_building.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// 20 m2 with 5 W/m2 of equipment (electricity); gas heating at 0.9, electric cooling
/// at 3.
Building office() {
    Building building = test::simple_building();
    Load water;
    water.name = "hot_water";
    water.density.value = 4;
    water.heat_fraction = 0;
    water.carrier = Carrier::gas;
    water.efficiency.value = 0.8;
    building.zones[0].loads.push_back(water);
    return building;
}

Trajectory constant_powers(std::size_t n_zones, std::size_t n, double heating,
                           double cooling, double theta_air) {
    const std::vector<double> none(n), air(n, theta_air);
    return {std::vector<ZoneTrajectory>(n_zones,
                                        {air, none, none, std::vector<double>(n, heating),
                                         std::vector<double>(n, cooling)})};
}

TEST(Meters, ConvertHeatByThePlant) {
    const Building building = office();
    const Drive drive = test::constant_drive(building, 3, 5);
    const Trajectory t = constant_powers(1, 3, 900, 300, 21);
    const auto shown = [&](Quantity quantity) {
        return predict(building, drive, t, quantity)[1];
    };
    EXPECT_NEAR(shown(Quantity::heating), 0.9, 1e-15);
    EXPECT_NEAR(shown(Quantity::cooling), 0.3, 1e-15);
    EXPECT_NEAR(shown(Quantity::gas), 1 + 0.08 / 0.8, 1e-15);
    EXPECT_NEAR(shown(Quantity::electricity), 0.1 + 0.1, 1e-15);
    EXPECT_EQ(shown(Quantity::district), 0);
    EXPECT_NEAR(shown(Quantity::air_temperature), 21, 1e-13);
}

TEST(Meters, CountTheEnergyOfShortSteps) {
    const Building building = office();
    const Drive drive = test::constant_drive(building, 6, 5, 0, 600);
    const Trajectory t = constant_powers(1, 6, 900, 0, 21);
    EXPECT_NEAR(predict(building, drive, t, Quantity::heating)[0], 0.15, 1e-15);
}

TEST(Meters, SumOverZonesAndWeighTemperatureByFloor) {
    Building building = office();
    building.zones.push_back(test::simple_zone("hall"));
    building.zones[1].floor_area = 60;
    const Drive drive = test::constant_drive(building, 1, 5);
    Trajectory t = constant_powers(2, 1, 900, 0, 20);
    t.zones[1].theta_air[0] = 24;
    EXPECT_NEAR(predict(building, drive, t, Quantity::heating)[0], 1.8, 1e-15);
    EXPECT_NEAR(predict(building, drive, t, Quantity::air_temperature)[0], 23, 1e-13);
}

TEST(Meters, LeaveTheWarmUpOut) {
    Building building = office();
    building.plant.heating_efficiency = {0.9, 0.45, 0};
    Drive drive = test::constant_drive(building, 4, 5, 0, 3600, 1);
    drive.profiles(0, 2) = 1;
    drive.n_warm_up = 2;
    const Trajectory t = constant_powers(1, 2, 900, 0, 20);
    const std::vector<double> gas = predict(building, drive, t, Quantity::gas);
    ASSERT_EQ(gas.size(), 2u);
    EXPECT_NEAR(gas[0], 1.1, 1e-15);
    EXPECT_NEAR(gas[1], 2.1, 1e-15);
}

TEST(Meters, ShowEveryCarrierOfThePlant) {
    Building building = office();
    building.plant.heating_carrier = Carrier::district;
    building.plant.cooling_carrier = Carrier::none;
    const Drive drive = test::constant_drive(building, 1, 5);
    EXPECT_NEAR(meter_form(building, drive, Quantity::district, 0).per_heating, 1 / 0.9,
                1e-15);
    EXPECT_EQ(meter_form(building, drive, Quantity::gas, 0).per_heating, 0);
    EXPECT_EQ(meter_form(building, drive, Quantity::electricity, 0).per_cooling, 0);
    EXPECT_NEAR(meter_form(building, drive, Quantity::electricity, 0).source, 100, 1e-12);
}

TEST(Meters, RefuseAnEfficiencyOfZero) {
    Building building = office();
    const Drive drive = test::constant_drive(building, 1, 5);
    building.plant.heating_efficiency.value = 0;
    EXPECT_THROW(meter_form(building, drive, Quantity::gas, 0), std::domain_error);
    EXPECT_NO_THROW(meter_form(building, drive, Quantity::electricity, 0));
    building.zones[0].loads[0].efficiency.value = std::nan("");
    EXPECT_THROW(meter_form(building, drive, Quantity::electricity, 0),
                 std::domain_error);
}

TimeAxis axis_from(const char* start, int n_steps, int step_s = 3600) {
    TimeAxis axis;
    axis.start = parse_time(start);
    axis.n_steps = n_steps;
    axis.step_s = step_s;
    return axis;
}

TEST(Meters, CutThePeriodByTheCalendar) {
    const TimeAxis axis = axis_from("2021-01-30 22:00", 60);
    EXPECT_EQ(interval_bounds(axis, Interval::daily),
              (std::vector<int>{0, 2, 26, 50, 60}));
    EXPECT_EQ(interval_bounds(axis, Interval::monthly), (std::vector<int>{0, 26, 60}));
    EXPECT_EQ(interval_bounds(axis, Interval::annual), (std::vector<int>{0, 60}));
    EXPECT_EQ(interval_bounds(axis, Interval::hourly).size(), 61u);
    const TimeAxis fine = axis_from("2021-12-31 23:30", 9, 600);
    EXPECT_EQ(interval_bounds(fine, Interval::hourly), (std::vector<int>{0, 3, 9}));
    EXPECT_EQ(interval_bounds(fine, Interval::annual), (std::vector<int>{0, 3, 9}));
    EXPECT_EQ(interval_bounds(fine, Interval::step).size(), 10u);
}

TEST(Meters, KnowTheMonthsOfALeapYear) {
    const auto bounds = interval_bounds(axis_from("2020-01-01", 8784), Interval::monthly);
    ASSERT_EQ(bounds.size(), 13u);
    EXPECT_EQ(bounds[2] - bounds[1], 29 * 24);
}

// Bills of 5 and 9 January and 2 February, over all of January.
TEST(Meters, KnowBillsOfAnyLength) {
    const Intervals bills(Interval::monthly,
                          {parse_time("2021-01-05"), parse_time("2021-01-09 06:00"),
                           parse_time("2021-02-02")});
    EXPECT_EQ(interval_bounds(axis_from("2021-01-01", 744), bills),
              (std::vector<int>{0, 96, 198, 744}));
    EXPECT_EQ(interval_bounds(axis_from("2021-01-05", 24), bills),
              (std::vector<int>{0, 24}));
    EXPECT_EQ(interval_bounds(axis_from("2021-03-01", 24), bills),
              (std::vector<int>{0, 24}));
    EXPECT_EQ(interval_bounds(axis_from("2021-01-01", 0), bills), (std::vector<int>{0}));
    EXPECT_EQ(bills, Interval::monthly);
    EXPECT_DOUBLE_EQ(hours_of(bills, 3600), 14 * 24);
    EXPECT_DOUBLE_EQ(hours_of(Interval::monthly, 3600), 730);
}

TEST(Meters, SumEnergyAndAverageTemperature) {
    std::vector<double> steps = {1, 2, 3, 4, 5};
    const std::vector<int> bounds = {0, 2, 5};
    EXPECT_EQ(aggregate(steps, bounds, Quantity::gas), (std::vector<double>{3, 12}));
    EXPECT_EQ(aggregate(steps, bounds, Quantity::air_temperature),
              (std::vector<double>{1.5, 4}));
    steps[0] = std::nan("");
    EXPECT_TRUE(std::isnan(aggregate(steps, bounds, Quantity::gas)[0]));
    EXPECT_EQ(aggregate(steps, bounds, Quantity::gas)[1], 12);
}

TEST(Meters, KeepTheTotalInEveryInterval) {
    const Building building = office();
    const Drive drive = test::swinging_drive(building, 2000, 5, 300);
    const Trajectory t = simulate(building, drive);
    const std::vector<double> gas = predict(building, drive, t, Quantity::gas);
    const double total = std::accumulate(gas.begin(), gas.end(), 0.0);
    for (Interval interval : {Interval::hourly, Interval::daily, Interval::monthly}) {
        const auto parts =
            aggregate(gas, interval_bounds(drive.axis, interval), Quantity::gas);
        EXPECT_NEAR(std::accumulate(parts.begin(), parts.end(), 0.0), total, 1e-9 * total)
            << name_of(interval);
    }
}

TEST(Meters, HaveNamesAndUnits) {
    EXPECT_STREQ(name_of(Quantity::district), "district");
    EXPECT_STREQ(unit_of(Quantity::gas), "kWh");
    EXPECT_STREQ(unit_of(Quantity::air_temperature), "degC");
    EXPECT_STREQ(name_of(Interval::monthly), "monthly");
}

}  // namespace
}  // namespace bemcal::physics
