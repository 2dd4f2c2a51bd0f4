/// Functions of hours, weather and time: their drivers and their sums.
#include "effects/driver_functions.hpp"
#include "office.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using functions::Points;
using test::Office;

DriverFunction constant(double value) {
    return {"one", {}, {value}};
}

TEST(DriverFunctions, AddUpAtAHook) {
    const Office office;
    const FunctionDrivers drivers = function_drivers(office.around);
    DriverFunction by_wind{"wind", {Points::Kind::knots, {0, 100}}, {0, 100}};
    const auto sum = column_of(Hook::gains, {constant(2), by_wind}, drivers);
    const auto& wind = office.around.weather.at(Driver::wind);
    ASSERT_EQ(sum.size(), wind.size());
    for (std::size_t k = 0; k < sum.size(); ++k) ASSERT_NEAR(sum[k], 2 + wind[k], 1e-12);
}

// A share of -1 would take all away; of what is added there is no such end.
TEST(DriverFunctions, OfSharesStopBeforeNothingIsLeft) {
    const FunctionDrivers drivers = function_drivers(Office().around);
    const auto at = [&](Hook hook, double value) {
        return column_of(hook, {constant(value)}, drivers)[0];
    };
    EXPECT_EQ(at(Hook::aperture, -0.89), -0.89);
    EXPECT_EQ(at(Hook::aperture, -0.91), -0.9);
    EXPECT_EQ(at(Hook::gains, -2), -2);
}

TEST(DriverFunctions, HolidaysAreSundaysByTheWallClock) {
    Office office;
    office.around.clock.holidays = {{0, 7, 5, 0, 7, 5}};  // a Monday
    office.around.clock.summer_time = "eu";
    office.around.clock.utc_offset_h = 1;
    const auto hours = function_drivers(office.around).at("hour of the week")[0];
    const physics::TimeAxis& axis = office.drive.axis;
    const auto at = [&](const char* time) {
        return hours[static_cast<std::size_t>(axis.step_of(physics::parse_time(time)))];
    };
    EXPECT_EQ(at("2021-01-20T08:00"), 8);       // a Wednesday
    EXPECT_EQ(at("2021-07-03T08:00"), 24 + 9);  // a Saturday, in summer
    EXPECT_EQ(at("2021-07-05T08:00"), 48 + 9);  // the holiday
    EXPECT_EQ(at("2021-07-05T23:00"), 0);       // Tuesday has begun
}

TEST(DriverFunctions, DriversHaveNamesAndUnits) {
    const auto names = function_driver_names();
    EXPECT_EQ(std::ranges::count(names, "heating load"), 1);
    EXPECT_EQ(std::ranges::count(names, "wind"), 1);
    EXPECT_TRUE(follows_loads("cooling load"));
    EXPECT_FALSE(follows_loads("time"));
    EXPECT_EQ(unit_of_driver("heating load"), "kW");
    EXPECT_EQ(unit_of_driver("time"), "a");
    EXPECT_EQ(unit_of_driver("one"), "");
    EXPECT_EQ(unit_of_driver("hour and outdoor temperature of a day"), "degC");
}

}  // namespace
}  // namespace bemcal::effects
