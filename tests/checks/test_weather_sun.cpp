/// Days whose sun somebody wrote as 0.
#include "checks/series.hpp"
#include "study/small_case.hpp"

#include <gtest/gtest.h>

namespace bemcal::checks {
namespace {

void darken(physics::Weather& weather, int first_hour, int n) {
    for (auto* series : {&weather.global_horizontal, &weather.direct_normal,
                         &weather.diffuse_horizontal})
        std::fill_n(series->begin() + first_hour, n, 0.0);
}

TEST(WeatherSun, DaysWithoutAnyAreStated) {
    study::Case made = test::small_case();
    check_weather_sun(made);
    EXPECT_TRUE(made.decisions.empty());
    darken(made.weather, 24 * 10, 48);
    darken(made.weather, 24 * 15, 24);  // but for one hour
    made.weather.global_horizontal[24 * 15 + 12] = 1;
    check_weather_sun(made);
    ASSERT_EQ(made.decisions.size(), 1U);
    EXPECT_EQ(made.decisions[0].finding.substr(0, 26), "2 days without any sun, th");
}

TEST(WeatherSun, HoursThatAreLackingAndOtherPartsAreNoDarkness) {
    study::Case made = test::small_case();
    darken(made.weather, 24 * 10, 24);
    made.weather.theta_e[24 * 10 + 5] = nan;
    std::fill_n(made.weather.global_horizontal.begin() + 24 * 15, 24, 0.0);
    check_weather_sun(made);
    EXPECT_TRUE(made.decisions.empty());
}

TEST(WeatherSun, PolarNightsAreDark) {
    study::Case made = test::small_case();
    made.weather.site.latitude = 69;  // Tromso
    made.weather.axis.start = physics::parse_time("2021-12-05");
    darken(made.weather, 0, made.weather.axis.n_steps);
    check_weather_sun(made);
    EXPECT_TRUE(made.decisions.empty());
    made.weather.site.latitude = 63.6;  // the sun stands 4 degrees high at noon
    check_weather_sun(made);
    EXPECT_TRUE(made.decisions.empty());
    made.weather.site.latitude = 60;
    check_weather_sun(made);
    EXPECT_EQ(made.decisions.size(), 1U);
}

}  // namespace
}  // namespace bemcal::checks
