#include "calibration/target_simulator.hpp"
#include "physics/simulate.hpp"
#include "study/points.hpp"
#include "study/small_case.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using physics::Quantity;

/// Every step of the nominal building by the plain version.
std::vector<double> plain_steps(const Case& building, const Period& period,
                                Quantity quantity) {
    const physics::Drive drive = drive_of(building, period);
    return physics::predict(building.building, drive,
                            physics::simulate(building.building, drive), quantity);
}

TEST(TargetSimulator, GivesTotalsMonthsAndPeaksOfThePlainSimulation) {
    Case building = test::small_case();
    building.periods[0] = {"training", test::day(20), test::day(34)};
    building.weather = test::made_up_weather(40);
    const Period& period = building.periods[0];
    const auto simulator = calibration::make_target_simulator(
        building, period,
        {{Quantity::heating, calibration::Statistic::peak},
         {Quantity::electricity, calibration::Statistic::months},
         {Quantity::air_temperature, calibration::Statistic::period},
         {Quantity::heating, calibration::Statistic::period}});
    std::vector<std::string> names;
    for (const Output& output : simulator->outputs())
        names.push_back(output.name + " " + output.unit);
    EXPECT_EQ(names,
              (std::vector<std::string>{"peak heating kW", "electricity 2021-04 kWh",
                                        "electricity 2021-05 kWh", "air_temperature degC",
                                        "heating kWh"}));
    Matrix answers;
    std::vector<std::string> failures;
    simulator->evaluate(nominal_row(building.parameters), answers, failures);
    const auto heating = plain_steps(building, period, Quantity::heating),
               power = plain_steps(building, period, Quantity::electricity),
               air = plain_steps(building, period, Quantity::air_temperature);
    const auto sum = [](const std::vector<double>& x, std::size_t from, std::size_t to) {
        return std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(from),
                               x.begin() + static_cast<std::ptrdiff_t>(to), 0.0);
    };
    const std::size_t n = heating.size(), april = 10 * 24;
    EXPECT_NEAR(answers(0, 0), *std::ranges::max_element(heating), 1e-9);
    EXPECT_NEAR(answers(0, 1), sum(power, 0, april), 1e-8);
    EXPECT_NEAR(answers(0, 2), sum(power, april, n), 1e-8);
    EXPECT_NEAR(answers(0, 3), sum(air, 0, n) / static_cast<double>(n), 1e-9);
    EXPECT_NEAR(answers(0, 4), sum(heating, 0, n), 1e-7);
}

Meter hourly_meter(const Case& building, double value) {
    Meter meter;
    meter.name = "power";
    meter.quantity = Quantity::electricity;
    meter.axis = building.weather.axis;
    meter.values.assign(static_cast<std::size_t>(meter.axis.n_steps), value);
    return meter;
}

TEST(MeasuredOutputs, AreTheMetersTotalAndHighestHour) {
    Case building = test::small_case();
    building.meters = {hourly_meter(building, 2)};
    building.meters[0].values[24 * 9] = 7;
    const Period& period = building.periods[0];
    const auto total = calibration::measured_outputs(
        {Quantity::electricity, calibration::Statistic::period}, building, period, 0);
    EXPECT_EQ(total, (std::vector<double>{2.0 * 240 + 5}));
    const auto peak = calibration::measured_outputs(
        {Quantity::electricity, calibration::Statistic::peak}, building, period, 0);
    EXPECT_EQ(peak, (std::vector<double>{7}));
}

TEST(MeasuredOutputs, OfATemperatureAreMeans) {
    Case building = test::small_case();
    building.meters = {hourly_meter(building, 20)};
    building.meters[0].quantity = Quantity::air_temperature;
    const auto mean = calibration::measured_outputs(
        {Quantity::air_temperature, calibration::Statistic::period}, building,
        building.periods[0], 0);
    EXPECT_NEAR(mean.at(0), 20, 1e-12);
}

TEST(MeasuredOutputs, AreRefusedWhereReadingsAreMissing) {
    Case building = test::small_case();
    building.meters = {hourly_meter(building, 2)};
    building.meters[0].values[24 * 9] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(calibration::measured_outputs(
                     {Quantity::electricity, calibration::Statistic::period}, building,
                     building.periods[0], 0),
                 std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::study
