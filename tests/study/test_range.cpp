#include "base/nan.hpp"
#include "study/measured_case.hpp"
#include "study/range.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

using test::measured_case;

double gas_at(const Case& building, const std::vector<double>& point) {
    const physics::Drive drive = drive_of(building, building.periods[0]);
    physics::Building variant = building.building;
    physics::apply(building.building, building.parameters, point, variant);
    const auto gas = physics::predict(variant, drive, physics::simulate(variant, drive),
                                      physics::Quantity::gas);
    return std::accumulate(gas.begin(), gas.end(), 0.0);
}

TEST(Range, AnEnergyThatTheModelMadeLiesWithinIt) {
    const auto ranges = ranges_of(measured_case(), 0, {});
    ASSERT_EQ(ranges.size(), 1U);  // a temperature has no total
    EXPECT_EQ(ranges[0].meter, 0U);
    EXPECT_NEAR(ranges[0].measured, gas_at(measured_case(), test::true_values), 1e-6);
    EXPECT_LT(ranges[0].least, ranges[0].measured);
    EXPECT_GT(ranges[0].most, ranges[0].measured);
    EXPECT_TRUE(ranges[0].is_reached(0));
}

TEST(Range, ReachesToTheCornersWhereATotalIsHighAndLow) {
    const Case building = measured_case();
    const MeterRange range = ranges_of(building, 0, {}).at(0);
    EXPECT_EQ(range.n_points, 1 + 64 + 2);
    EXPECT_NEAR(range.most, gas_at(building, {1.5, 0.3, 22}), 1e-6);
    EXPECT_NEAR(range.least, gas_at(building, {0.3, 0.7, 20}), 1e-6);
    EXPECT_NEAR(range.nominal, gas_at(building, {0.8, 0.5, 21}), 1e-6);
}

TEST(Range, WithoutParametersIsOnePoint) {
    Case building = measured_case();
    building.parameters.clear();
    const MeterRange range = ranges_of(building, 0, {}).at(0);
    EXPECT_EQ(range.n_points, 1);
    EXPECT_EQ(range.least, range.nominal);
    EXPECT_EQ(range.most, range.nominal);
}

TEST(Range, IsOfTheIntervalsThatHaveAReading) {
    Case building = measured_case();
    const MeterRange whole = ranges_of(building, 0, {}).at(0);
    for (std::size_t k = 0; k < 120; ++k) building.meters[0].values[k] = nan;
    const MeterRange half = ranges_of(building, 0, {}).at(0);
    EXPECT_LT(half.measured, whole.measured);
    EXPECT_LT(half.most, whole.most);
    EXPECT_TRUE(half.is_reached(0));
}

TEST(Range, LeavesOutMetersWithoutATotalAndThoseThatAreNotNamed) {
    Case building = measured_case();
    EXPECT_TRUE(ranges_of(building, 0, {"air_temperature"}).empty());
    EXPECT_EQ(ranges_of(building, 0, {"gas"}).size(), 1U);
    for (double& value : building.meters[0].values) value = 0;
    EXPECT_TRUE(ranges_of(building, 0, {}).empty());
    for (double& value : building.meters[0].values) value = -1;
    EXPECT_TRUE(ranges_of(building, 0, {}).empty());
    for (double& value : building.meters[0].values) value = nan;
    EXPECT_TRUE(ranges_of(building, 0, {}).empty());
}

TEST(Range, LeavesOutAMeterThatShowsNextToNothingBesideTheOthers) {
    Case building = measured_case();
    building.meters[1] = building.meters[0];
    building.meters[1].name = "cooling";
    building.meters[1].quantity = physics::Quantity::cooling;
    EXPECT_EQ(ranges_of(building, 0, {}).size(), 2U);  // it shows as much as the gas
    building.building.zones[0].thermostat.cooling_set_point = {90, 0, -1};
    EXPECT_EQ(ranges_of(building, 0, {}).size(), 2U);
    for (double& value : building.meters[1].values) value *= 1e-3;
    EXPECT_EQ(ranges_of(building, 0, {}).size(), 1U);
    EXPECT_EQ(ranges_of(building, 0, {"cooling"}).size(), 1U);  // there is no other
}

TEST(Range, ADiscreteParameterTakesItsValuesOnly) {
    Case building = measured_case();
    building.priors.resize(3);
    building.priors[0].values = {0.6, 0.9};
    const MeterRange range = ranges_of(building, 0, {}).at(0);
    EXPECT_NEAR(range.most, gas_at(building, {0.9, 0.3, 22}), 1e-6);
    EXPECT_NEAR(range.least, gas_at(building, {0.6, 0.7, 20}), 1e-6);
}

TEST(Range, ATotalIsReachedAsFarAsABiasMayBe) {
    MeterRange range;
    range.least = 50;
    range.most = 100;
    const auto reaches = [&](double measured) {
        range.measured = measured;
        return range.is_reached(0.05);
    };
    EXPECT_TRUE(reaches(75));
    EXPECT_TRUE(reaches(105));   // 0.95 x 105 = 99.75
    EXPECT_FALSE(reaches(106));  // 0.95 x 106 = 100.7
    EXPECT_TRUE(reaches(48));    // 1.05 x 48 = 50.4
    EXPECT_FALSE(reaches(47));   // 1.05 x 47 = 49.35
}

}  // namespace
}  // namespace bemcal::study
