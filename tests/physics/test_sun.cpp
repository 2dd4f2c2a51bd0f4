/// The sun against NREL's SPA: published points, and every sunlit hour of a year at
/// Denver.
#include "physics/sun.hpp"
#include "support/csv_table.hpp"
#include "support/measured.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

constexpr double deg = std::numbers::pi / 180;

// NREL/TP-560-34302, worked example: elevation without refraction and azimuth.
const Site golden{39.742476, -105.1786, -7, 1830.14};

TEST(Sun, WorkedExampleOfSpa) {
    const SunPosition sun = sun_position(golden, parse_time("2003-10-17 12:30:30"));
    EXPECT_NEAR(90 - sun.zenith / deg, 39.872046, 0.01);
    EXPECT_NEAR(sun.azimuth / deg, 194.340241, 0.01);
    EXPECT_NEAR(sun.extraterrestrial, 1366.1 / std::pow(0.9965422974, 2), 0.1);
}

TEST(Sun, NextDayOfSpa) {
    // pvlib tests/test_solarposition.py, expected_solpos_multi
    const SunPosition sun = sun_position(golden, parse_time("2003-10-18 12:30:30"));
    EXPECT_NEAR(90 - sun.zenith / deg, 39.505196, 0.01);
    EXPECT_NEAR(sun.azimuth / deg, 194.311132, 0.01);
}

struct Day {
    Site site;
    const char *date, *rise, *transit, *set;
};

// NREL's SPA on the web, as in pvlib's tests. Rise and set: centre 0.8333 deg below the
// horizon. The second sunset is printed there as 19:13:58, which cannot be: 29 s longer
// after noon than before it while the days get shorter. Left out.
const Day spa_days[] = {
    {{39.742476, -105.1786, -7}, "2015-01-02", "07:21:55", "12:04:45", "16:47:43"},
    {{39.742476, -105.1786, -7}, "2015-08-02", "05:00:27", "12:06:58", nullptr},
    {{-35, 0, 0}, "1996-07-05", "07:08:15", "12:04:36", "17:01:04"},
    {{-35, 0, 0}, "2004-12-04", "04:38:57", "11:50:22", "19:02:03"},
};

TEST(Sun, RisesAndSetsAsInSpa) {
    for (const Day& day : spa_days)
        for (const char* clock : {day.rise, day.set}) {
            if (clock == nullptr) continue;
            const Seconds time = parse_time(std::string(day.date) + " " + clock);
            EXPECT_NEAR(sun_position(day.site, time).zenith / deg, 90.8333, 0.02)
                << day.date << ' ' << clock;
        }
}

TEST(Sun, TransitsAsInSpa) {
    for (const Day& day : spa_days) {
        const SunPosition sun =
            sun_position(day.site, parse_time(std::string(day.date) + " " + day.transit));
        EXPECT_NEAR(std::sin(sun.azimuth), 0, 0.02 * deg / std::sin(sun.zenith))
            << day.date;
    }
}

TEST(Sun, EveryHourOfDenverAsInSpa) {
    const auto file = test::shared_file("thermal/solar_pvlib_denver_8760.csv");
    if (test::is_absent(file)) GTEST_SKIP() << file;
    const test::CsvTable table(file);
    const Site denver{39.83, -104.65, -7, 1650};
    const Seconds start = parse_time("2001-01-01 00:30");  // the year of that run
    double most_zenith = 0, most_azimuth = 0;
    int n = 0;
    for (std::size_t k = 0; k < table.n_rows(); ++k) {
        const double zenith = table.number(k, "zenith_deg");
        if (zenith >= 90) continue;
        const SunPosition sun = sun_position(denver, start + std::chrono::hours(k));
        const double turn =
            std::remainder(sun.azimuth / deg - table.number(k, "azimuth_deg"), 360);
        most_zenith = std::max(most_zenith, std::abs(sun.zenith / deg - zenith));
        most_azimuth = std::max(most_azimuth, std::abs(turn * std::sin(sun.zenith)));
        ++n;
    }
    test::print_measured("sun's zenith, Denver, largest error of a year against SPA",
                         most_zenith, "deg", "0.05");
    test::print_measured("sun's azimuth times sin(zenith), the same", most_azimuth, "deg",
                         "0.05");
    EXPECT_GT(n, 4000);
    EXPECT_LE(most_zenith, 0.05);
    EXPECT_LE(most_azimuth, 0.05);
}

TEST(Sun, StepsWithSunriseStandForTheirSunlitPart) {
    const TimeAxis day{parse_time("2015-08-02"), 3600, 24};
    const Site& site = spa_days[1].site;
    const std::vector<StepSun> suns = step_suns(site, day, SunOfStep::sunlit_part);
    double sunlit = 0;
    for (std::size_t k = 0; k < suns.size(); ++k) {
        sunlit += suns[k].sunlit;
        if (suns[k].sunlit > 0) {
            EXPECT_LT(suns[k].position.zenith, 90 * deg) << k;
        }
        const SunPosition middle = sun_position(
            site, day.begin_of(static_cast<int>(k)) + std::chrono::minutes(30));
        if (suns[k].sunlit == 0 || suns[k].sunlit == 1) {
            EXPECT_EQ(suns[k].position.zenith, middle.zenith) << k;
        }
    }
    // The day by the plain way: minute by minute.
    int minutes = 0;
    for (int m = 0; m < 1440; ++m)
        minutes +=
            sun_position(site, day.start + std::chrono::seconds(60 * m + 30)).zenith <
            90 * deg;
    EXPECT_NEAR(sunlit, minutes / 60.0, 0.02);
}

TEST(Sun, MiddleOfTheStep) {
    const TimeAxis day{parse_time("2015-08-02"), 3600, 24};
    const std::vector<StepSun> suns = step_suns(golden, day);
    for (int k = 0; k < 24; ++k) {
        const StepSun& sun = suns[static_cast<std::size_t>(k)];
        const SunPosition middle =
            sun_position(golden, day.begin_of(k) + std::chrono::minutes(30));
        EXPECT_EQ(sun.position.zenith, middle.zenith);
        EXPECT_EQ(sun.sunlit, middle.zenith < 90 * deg ? 1 : 0);
    }
}

TEST(Sun, PolarNightAndPolarDay) {
    const Site tromso{69.65, 18.96, 1};
    for (const StepSun& sun :
         step_suns(tromso, {parse_time("2021-12-21"), 3600, 24}, SunOfStep::sunlit_part))
        EXPECT_EQ(sun.sunlit, 0);
    for (const StepSun& sun :
         step_suns(tromso, {parse_time("2021-06-21"), 3600, 24}, SunOfStep::sunlit_part))
        EXPECT_EQ(sun.sunlit, 1);
}

TEST(Sun, IncidenceOnPlanesThatFaceItOrTurnAway) {
    const SunPosition sun{50 * deg, 194 * deg, 1367};
    EXPECT_NEAR(cos_incidence(sun, 50 * deg, 194 * deg), 1, 1e-12);
    EXPECT_NEAR(cos_incidence(sun, 0, 77 * deg), std::cos(50 * deg), 1e-12);
    EXPECT_NEAR(cos_incidence(sun, 90 * deg, 14 * deg), -std::sin(50 * deg), 1e-12);
}

TEST(Sun, IncidenceOfSpasWorkedExample) {
    // NREL/TP-560-34302: slope 30 deg, 10 deg east of south: 25.18700 deg, with
    // refraction.
    const SunPosition sun = sun_position(golden, parse_time("2003-10-17 12:30:30"));
    EXPECT_NEAR(std::acos(cos_incidence(sun, 30 * deg, 170 * deg)) / deg, 25.187, 0.03);
}

}  // namespace
}  // namespace bemcal::physics
