/// A zone's part of its air system: which air it gets, and when.
#include "physics/air_hour.hpp"
#include "support/simple_building.hpp"

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// A room of 50 m3 whose fan runs from the second hour on.
Building supplied_room() {
    Building building = test::simple_building();
    AirSystem system;
    system.available = {1, 0, 0};
    building.air_systems.push_back(system);
    building.zones[0].air_system = 0;
    return building;
}

Drive fan_from_the_second_hour(const Building& building) {
    Drive drive = test::constant_drive(building, 4, 30, 0, 3600, 1);
    for (std::size_t step = 1; step < 4; ++step) drive.profiles(0, step) = 1;
    return drive;
}

}  // namespace

TEST(AirHour, AFanThatStartsFindsARoomOfOutdoorAir) {
    const Building building = supplied_room();
    const Drive drive = fan_from_the_second_hour(building);
    const auto other_air = [&](int step) {
        return air_hour(building, building.zones[0], drive, step).q_inf * 3600;
    };
    EXPECT_NEAR(other_air(0), 25, 1e-12);
    EXPECT_NEAR(other_air(1), 25 + 50, 1e-12);
    EXPECT_NEAR(other_air(2), 25, 1e-12);
}

TEST(AirHour, AirFromABoundaryIsTheLeastSupplyAirWithItsTemperature) {
    Building building = supplied_room();
    building.boundaries.push_back({"supply", {14, 0, -1}});
    AirFlow least;
    least.name = "least";
    least.supply = 0;
    least.air_change.value = 2;
    building.zones[0].flows.push_back(least);
    building.zones[0].system_flow = 1;
    building.air_systems[0].outdoor_air_change.value = 0.8;
    const Drive drive = fan_from_the_second_hour(building);
    const AirHour hour = air_hour(building, building.zones[0], drive, 2);
    EXPECT_TRUE(air_kind(building, building.zones[0], drive).supplies);
    EXPECT_NEAR(hour.q_supplied * 3600, 100, 1e-12);
    EXPECT_NEAR(hour.q_e * 3600, 40, 1e-12);
    EXPECT_EQ(hour.theta_supply, 14);
}

}  // namespace bemcal::physics
