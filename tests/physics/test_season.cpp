/// Running means of the outdoor temperature, and rooms that are heated and cooled by
/// them.
#include "physics/season.hpp"
#include "physics/simulate.hpp"
#include "support/simple_building.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Days that have one temperature each, from a midnight on.
Weather days_of(const std::vector<double>& temperatures) {
    Weather weather;
    weather.axis = {parse_time("2021-03-01"), 3600,
                    24 * static_cast<int>(temperatures.size())};
    for (const double theta : temperatures)
        weather.theta_e.insert(weather.theta_e.end(), 24, theta);
    return weather;
}

/// Of each day at noon, in steps of half an hour.
std::vector<double> running(const Weather& weather) {
    const TimeAxis steps{weather.axis.start, 1800, 2 * weather.axis.n_steps};
    const std::vector<double> all = running_means(weather, steps);
    std::vector<double> noons;
    for (std::size_t k = 24; k < all.size(); k += 48) noons.push_back(all[k]);
    return noons;
}

TEST(RunningMean, IsOfTheDaysBeforeByEn16798) {
    // 0.2 of the day before, 0.8 of what it was: 10, 10, 12.2, 13.96, 11.168
    EXPECT_EQ(running(days_of({10, 21, 21, 0, 5})),
              (std::vector<double>{10.25, 10.25, 12.25, 13.75, 11.25}));
}

TEST(RunningMean, StaysWhereADayHasNoValue) {
    EXPECT_EQ(running(days_of({nan, 10, nan, 21, 21})),
              (std::vector<double>{10.25, 10.25, 10.25, 10.25, 12.25}));
    // A day's mean is that of the hours which are known.
    Weather gaps = days_of({0, 21, 0});
    for (int k = 0; k < 20; ++k) gaps.theta_e[static_cast<std::size_t>(24 + k)] = nan;
    EXPECT_EQ(running(gaps), (std::vector<double>{0.25, 0.25, 4.25}));
}

TEST(RunningMean, IsThatOfTheWeatherBeforeAPeriod) {
    Weather weather = days_of({10, 21, 21, 0, 5});
    const Drive drive = make_drive(weather, {}, {}, parse_time("2021-03-04"),
                                   parse_time("2021-03-05"), 3600, 24);
    EXPECT_EQ(drive.theta_rm[0], 12.25);
    EXPECT_EQ(drive.theta_rm[47], 13.75);
}

TEST(Season, ShareOfRoomsFallsOverTheRamp) {
    Structure structure;
    EXPECT_EQ(heated_share(structure, 40), 1);
    EXPECT_EQ(cooled_share(structure, -40), 1);
    structure.heating_limit = structure.cooling_limit = 15;
    EXPECT_EQ(heated_share(structure, 13.9), 1);
    EXPECT_EQ(heated_share(structure, 15.5), 0.25);
    EXPECT_EQ(heated_share(structure, 16.1), 0);
    EXPECT_EQ(cooled_share(structure, 15.5), 0.75);
    EXPECT_EQ(cooled_share(structure, 13.9), 0);
}

/// A heated and cooled room at one running mean.
Trajectory run(double theta_e, double theta_rm, double heating_limit,
               double cooling_limit) {
    Building building = bemcal::test::simple_building();
    Structure& structure = building.zones[0].structure;
    structure.heating_limit = heating_limit;
    structure.cooling_limit = cooling_limit;
    Drive drive = bemcal::test::constant_drive(building, 48, theta_e, 100);
    drive.theta_rm.assign(48, theta_rm);
    return simulate(building, drive);
}

TEST(Season, PowerIsTheShareOfThatForAllRooms) {
    const Trajectory all = run(5, 14, unlimited, -unlimited),
                     half = run(5, 14, 14, -unlimited), none = run(5, 14, 12, -unlimited);
    EXPECT_GT(all.zones[0].heating[0], 50);
    EXPECT_NEAR(half.zones[0].heating[0], 0.5 * all.zones[0].heating[0], 1e-9);
    EXPECT_EQ(none.zones[0].heating[40], 0);
    // The air is between that of rooms at the set-point and that of rooms left alone.
    EXPECT_NEAR(half.zones[0].theta_air[0],
                0.5 * (all.zones[0].theta_air[0] + none.zones[0].theta_air[0]), 1e-9);
}

TEST(Season, CoolingStopsInCoolWeather) {
    EXPECT_GT(run(30, 14, unlimited, 12).zones[0].cooling[40], 50);
    EXPECT_EQ(run(30, 14, unlimited, 16).zones[0].cooling[40], 0);
}

TEST(Season, ALimitBeyondTheWeatherChangesNothing) {
    const Trajectory without = run(5, 14, unlimited, -unlimited),
                     with = run(5, 14, 30, -30);
    for (std::size_t k = 0; k < 48; ++k)
        EXPECT_NEAR(with.zones[0].heating[k], without.zones[0].heating[k], 1e-9);
}

}  // namespace
}  // namespace bemcal::physics
