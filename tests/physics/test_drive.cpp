/// Weather and profiles laid on the steps of a period.
#include "physics/drive.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

std::size_t index(int k) {
    return static_cast<std::size_t>(k);
}

/// 30 days from a Monday on; temperature = number of the hour, irradiance isotropic.
Weather numbered_weather(int days = 30) {
    Weather weather;
    weather.site = {50, 10, 1};
    weather.axis = {parse_time("2021-03-01"), 3600, days * 24};
    for (int k = 0; k < weather.axis.n_steps; ++k) {
        weather.theta_e.push_back(k);
        weather.diffuse_horizontal.push_back(k);
    }
    weather.direct_normal.assign(index(weather.axis.n_steps), 0);
    weather.global_horizontal = weather.diffuse_horizontal;
    return weather;
}

Building one_plane() {
    Building building;
    building.planes = {Plane{}};
    return building;
}

Profile hour_of_day() {
    Profile profile;
    profile.name = "clock";
    for (Day& day : profile.schedule.week)
        for (int h = 0; h < 24; ++h) day[index(h)] = h;
    return profile;
}

Profile numbered_series(const TimeAxis& axis) {
    Profile profile;
    profile.name = "meter";
    profile.is_series = true;
    profile.axis = axis;
    for (int k = 0; k < axis.n_steps; ++k) profile.values.push_back(k);
    return profile;
}

Drive drive_of(const Weather& weather, const std::vector<Profile>& profiles,
               const char* from, const char* to, int step_s = 3600,
               int n_warm_up_hours = 0) {
    return make_drive(weather, one_plane(), profiles, parse_time(from), parse_time(to),
                      step_s, n_warm_up_hours, SkyModel::isotropic);
}

TEST(Drive, ValuesLandOnTheirHour) {
    const Weather weather = numbered_weather();
    const Drive drive = drive_of(weather, {hour_of_day(), numbered_series(weather.axis)},
                                 "2021-03-03", "2021-03-05");
    ASSERT_EQ(drive.n_steps(), 48);
    EXPECT_EQ(drive.n_warm_up, 0);
    EXPECT_EQ(format_time(drive.axis.start), "2021-03-03 00:00:00");
    for (int k = 0; k < 48; ++k) {
        EXPECT_EQ(drive.theta_e[index(k)], 48 + k);
        EXPECT_EQ(drive.irradiance(0, index(k)), 48 + k);
        EXPECT_EQ(drive.profiles(0, index(k)), k % 24);
        EXPECT_EQ(drive.profiles(1, index(k)), 48 + k);
    }
    EXPECT_EQ(drive.at(Input{10, 2, 0}, 5), 2 + 8 * 5);
    EXPECT_EQ(drive.at(Input{10, 2, -1}, 5), 10);
}

TEST(Drive, WarmUpTakesTheRealHoursBefore) {
    const Weather weather = numbered_weather();
    const Drive drive = drive_of(weather, {hour_of_day(), numbered_series(weather.axis)},
                                 "2021-03-03", "2021-03-05", 3600, 30);
    EXPECT_EQ(drive.n_warm_up, 30);
    EXPECT_EQ(drive.n_steps(), 78);
    EXPECT_EQ(format_time(drive.axis.start), "2021-03-01 18:00:00");
    for (int k = 0; k < 78; ++k) {
        EXPECT_EQ(drive.theta_e[index(k)], 18 + k);
        EXPECT_EQ(drive.profiles(0, index(k)), (18 + k) % 24);
        EXPECT_EQ(drive.profiles(1, index(k)), 18 + k);
    }
}

/// Each step of a warm-up before the first day must repeat the hour that stands
/// `expected` hours after the period's begin.
void expect_wrapped(const Drive& drive, int wrap_hours) {
    for (int k = 0; k < drive.n_warm_up; ++k) {
        const int before = drive.n_warm_up - k;  // hours before the period
        const int hour = (wrap_hours * 1000 - before) % wrap_hours;
        EXPECT_EQ(drive.theta_e[index(k)], hour) << k;
        EXPECT_EQ(drive.irradiance(0, index(k)), hour) << k;
        EXPECT_EQ(drive.profiles(0, index(k)), hour % 24) << k;
    }
}

TEST(Drive, WarmUpRepeatsTheFirstDaysWhereNothingIsBefore) {
    const Weather weather = numbered_weather();
    // 30 h need two days; a period of less than that is repeated as often as needed.
    expect_wrapped(
        drive_of(weather, {hour_of_day()}, "2021-03-01", "2021-03-29", 3600, 30), 48);
    expect_wrapped(
        drive_of(weather, {hour_of_day()}, "2021-03-01", "2021-03-02", 3600, 60), 24);
    expect_wrapped(
        drive_of(weather, {hour_of_day()}, "2021-03-01", "2021-03-01 06:00", 3600, 20),
        6);
}

TEST(Drive, AYearIsWarmedUpByDays52WeeksLater) {
    expect_wrapped(drive_of(numbered_weather(370), {hour_of_day()}, "2021-03-01",
                            "2022-03-01", 3600, 30),
                   364 * 24);
}

TEST(Drive, WarmUpRepeatsWhereASeriesBeginsLater) {
    const Weather weather = numbered_weather();
    const TimeAxis later =
        weather.axis.between(parse_time("2021-03-03"), weather.axis.end());
    const Drive drive =
        drive_of(weather, {numbered_series(later)}, "2021-03-03", "2021-03-05", 3600, 24);
    EXPECT_EQ(drive.theta_e[0], 48);  // the hours of 3 March, not of 2 March
    EXPECT_EQ(drive.profiles(0, 0), 0);
    Profile gap = numbered_series(weather.axis);
    gap.values[30] = nan;  // 2 March, 6:00
    const Drive behind = drive_of(weather, {gap}, "2021-03-03", "2021-03-05", 3600, 24);
    for (int k = 0; k < 24; ++k)  // the real ones from 7:00 on
        EXPECT_EQ(behind.profiles(0, index(k)), k < 7 ? 48 + k : 24 + k);
}

TEST(Drive, KnowsHowFarTheHoursBeforeReach) {
    const Weather weather = numbered_weather();
    const auto before = [&](const std::vector<Profile>& profiles, const char* from) {
        return known_hours_before(weather, one_plane(), profiles, parse_time(from), 100);
    };
    EXPECT_EQ(before({}, "2021-03-20"), 100);
    EXPECT_EQ(before({}, "2021-03-03"), 48);
    EXPECT_EQ(before({}, "2021-03-01"), 0);
    Profile gap = numbered_series(weather.axis);
    gap.values[30] = nan;  // 2 March, 6:00
    EXPECT_EQ(before({gap}, "2021-03-03"), 17);
    gap.axis = weather.axis.between(parse_time("2021-03-05"), weather.axis.end());
    EXPECT_EQ(before({gap}, "2021-03-03"), 0);
}

TEST(Drive, TenMinuteSteps) {
    const Weather weather = numbered_weather();
    const Drive drive = drive_of(weather, {hour_of_day(), numbered_series(weather.axis)},
                                 "2021-03-03 06:00", "2021-03-03 12:00", 600, 1);
    ASSERT_EQ(drive.n_steps(), 42);
    EXPECT_EQ(drive.n_warm_up, 6);
    for (int k = 0; k < 42; ++k) {
        const double minutes = 53 * 60 + 10 * k + 5;  // middle of the step since 1 March
        EXPECT_NEAR(drive.theta_e[index(k)], minutes / 60 - 0.5, 1e-12);
        EXPECT_EQ(drive.irradiance(0, index(k)), 53 + k / 6);
        EXPECT_EQ(drive.profiles(0, index(k)), 5 + k / 6);
        EXPECT_EQ(drive.profiles(1, index(k)), 53 + k / 6);
    }
}

TEST(Drive, ShortStepsKeepTheHoursMeanTemperature) {
    Weather weather = numbered_weather();
    for (int k = 0; k < weather.axis.n_steps; ++k)
        weather.theta_e[index(k)] = 10 + 5 * std::sin(2 * pi * k / 24);
    const Drive drive = drive_of(weather, {}, "2021-03-02", "2021-03-28", 600);
    double largest = 0, sum = 0, expected = 0;
    for (int hour = 0; hour < 26 * 24; ++hour) {
        double mean = 0;
        for (int k = 0; k < 6; ++k) mean += drive.theta_e[index(6 * hour + k)] / 6;
        largest = std::max(largest, std::abs(mean - weather.theta_e[index(24 + hour)]));
        sum += mean;
        expected += weather.theta_e[index(24 + hour)];
    }
    EXPECT_LT(largest, 0.05);  // of an amplitude of 5 K: the curve's bend is cut
    EXPECT_NEAR(sum, expected, 1e-6 * expected);
}

TEST(Drive, FinerSeriesAreAveraged) {
    const Weather weather = numbered_weather();
    const Profile fine =
        numbered_series({weather.axis.start, 600, weather.axis.n_steps * 6});
    const Drive drive = drive_of(weather, {fine}, "2021-03-02", "2021-03-03");
    for (int k = 0; k < 24; ++k)
        EXPECT_EQ(drive.profiles(0, index(k)), 6 * (24 + k) + 2.5);
}

TEST(Drive, LastHourOfTheWeatherIsReached) {
    const Weather weather = numbered_weather();
    const Drive drive = drive_of(weather, {}, "2021-03-30", "2021-03-31", 600);
    EXPECT_EQ(drive.theta_e.back(), 719);
    EXPECT_EQ(drive.irradiance(0, 143), 719);
}

std::string complaint(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "no complaint";
}

TEST(Drive, MissingValuesAreNamedWithTheirTime) {
    const auto with = [](std::vector<double> Weather::* series) {
        return complaint([&] {
            Weather weather = numbered_weather();
            (weather.*series)[60] = nan;  // 3 March, 12:00
            drive_of(weather, {}, "2021-03-03", "2021-03-05");
        });
    };
    EXPECT_EQ(with(&Weather::theta_e),
              "outdoor temperature is missing at 2021-03-03 12:00:00");
    EXPECT_EQ(with(&Weather::direct_normal),
              "direct irradiance is missing at 2021-03-03 12:00:00");
    EXPECT_EQ(with(&Weather::diffuse_horizontal),
              "diffuse irradiance is missing at 2021-03-03 12:00:00");
    EXPECT_EQ(with(&Weather::global_horizontal),
              "global irradiance is missing at 2021-03-03 12:00:00");
    EXPECT_EQ(complaint([] {
                  Profile profile = numbered_series(numbered_weather().axis);
                  profile.values[60] = nan;
                  drive_of(numbered_weather(), {profile}, "2021-03-03", "2021-03-05");
              }),
              "series 'meter' is missing at 2021-03-03 12:00:00");
}

TEST(Drive, MissingValuesOutsideThePeriodDoNotMatter) {
    Weather weather = numbered_weather();
    weather.theta_e[47] = weather.theta_e[96] = nan;
    weather.global_horizontal[10] = nan;
    const Drive drive = drive_of(weather, {}, "2021-03-03", "2021-03-05", 600);
    EXPECT_EQ(drive.theta_e.front(), 48);  // held where the neighbour is missing
    EXPECT_EQ(drive.theta_e.back(), 95);
}

TEST(Drive, RefusesWhatCannotBeLaidOut) {
    const Weather weather = numbered_weather();
    const auto says = [&](const char* from, const char* to, int step_s) {
        return complaint([&] { drive_of(weather, {}, from, to, step_s); });
    };
    EXPECT_NE(
        says("2021-02-01", "2021-03-05", 3600).find("the weather covers 2021-03-01"),
        std::string::npos);
    EXPECT_NE(says("2021-03-05", "2021-03-05", 3600).find("empty or reversed"),
              std::string::npos);
    EXPECT_NE(says("2021-03-05", "2021-03-06", 700).find("divides 3600"),
              std::string::npos);
    EXPECT_NE(says("2021-03-05", "2021-03-06", 0).find("divides 3600"),
              std::string::npos);
    EXPECT_NE(says("2021-03-05 00:30", "2021-03-06", 3600).find("step of 3600"),
              std::string::npos);
    EXPECT_NE(complaint([&] {
                  const TimeAxis part =
                      weather.axis.between(parse_time("2021-03-04"), weather.axis.end());
                  drive_of(weather, {numbered_series(part)}, "2021-03-03", "2021-03-05");
              }).find("series 'meter' covers 2021-03-04"),
              std::string::npos);
    EXPECT_NE(complaint([&] {
                  Weather half = weather;
                  half.direct_normal.clear();
                  drive_of(half, {}, "2021-03-03", "2021-03-05");
              }).find("direct irradiance has 0 values"),
              std::string::npos);
}

}  // namespace
}  // namespace bemcal::physics
