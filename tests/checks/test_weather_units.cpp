/// Made clear and cloudy weather in all the units that tables have, and its right unit.
#include "checks/weather_units.hpp"
#include "physics/sun.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace bemcal::checks {
namespace {

const physics::Site berlin{52.5, 13.4, 1};

input::RegularSeries empty(const char* from, int n_days, int step_s) {
    input::RegularSeries series;
    series.axis = {physics::parse_time(from), step_s, n_days * physics::day_s / step_s};
    return series;
}

/// Global irradiance [W/m2] at a clearness of 0.2 to 0.75 by day.
input::RegularSeries sunshine(const char* from, int n_days, int step_s = 3600) {
    input::RegularSeries series = empty(from, n_days, step_s);
    const auto suns = physics::step_suns(berlin, series.axis);
    for (std::size_t k = 0; k < suns.size(); ++k) {
        const auto day = static_cast<int>(k) * step_s / physics::day_s;
        const double clearness = 0.2 + 0.55 * (day % 5) / 4;
        series.values.push_back(clearness * suns[k].position.extraterrestrial *
                                std::max(std::cos(suns[k].position.zenith), 0.0));
    }
    return series;
}

/// 9 degC with a year's and a day's wave [degC].
input::RegularSeries air(const char* from, int n_days, double mean = 9) {
    input::RegularSeries series = empty(from, n_days, 3600);
    for (int k = 0; k < series.axis.n_steps; ++k) {
        const double day = physics::calendar_step(series.axis.begin_of(k)).day_of_year;
        series.values.push_back(mean -
                                10 * std::cos(2 * std::numbers::pi * (day - 20) / 365) -
                                4 * std::cos(2 * std::numbers::pi * (k % 24 - 3) / 24));
    }
    return series;
}

input::RegularSeries changed(input::RegularSeries series, double factor,
                             double offset = 0) {
    for (double& value : series.values) value = value * factor + offset;
    return series;
}

std::string doubt(const input::RegularSeries& series) {
    return doubt_of_irradiance(series, berlin, SunColumn::global_horizontal).value_or("");
}
std::string doubt_of_air(const input::RegularSeries& series) {
    return doubt_of_temperature(series, berlin).value_or("");
}

void expect_advice(const std::string& text, const std::string& advice) {
    EXPECT_NE(text.find("Write " + advice), std::string::npos) << text;
}

TEST(WeatherUnits, OfIrradianceAreKnownByTheSun) {
    const input::RegularSeries year = sunshine("2021-01-01", 365);
    EXPECT_EQ(doubt(year), "");
    expect_advice(doubt(changed(year, 3.6)), "unit = \"kJ/m2\"");
    expect_advice(doubt(changed(year, 0.36)), "unit = \"J/cm2\"");
    expect_advice(doubt(changed(year, 1e-3)), "unit = \"kW/m2\", or unit = \"kWh/m2\"");
    expect_advice(doubt(changed(year, 3.6e-3)), "unit = \"MJ/m2\"");
    expect_advice(doubt(changed(year, 3600)), "unit = \"J/m2\"");
    expect_advice(doubt(changed(year, 0.25)), "factor = 4 (Wh/m2 of 15 min)");
}

TEST(WeatherUnits, OfQuartersAreThoseOfTheStep) {
    const input::RegularSeries year = sunshine("2021-01-01", 365, 900);
    EXPECT_EQ(doubt(year), "");
    expect_advice(doubt(changed(year, 0.25)), "unit = \"Wh/m2\"");
    expect_advice(doubt(changed(year, 0.09)), "unit = \"J/cm2\"");
}

TEST(WeatherUnits, SayTheRatioAndHowToKeepThem) {
    EXPECT_EQ(doubt(changed(sunshine("2021-01-01", 365), 3.6)).substr(0, 76),
              "at its clearest middays it is 2.7 of what the sun sends outside the "
              "atmosphe");
    EXPECT_NE(doubt(changed(sunshine("2021-01-01", 365), 3.6))
                  .find("unit = \"W/m2\" if it is so"),
              std::string::npos);
}

TEST(WeatherUnits, OfWintersAreKnownTooThoughTheNumbersAreOrdinary) {
    const input::RegularSeries winter = changed(sunshine("2021-12-01", 20), 3.6);
    EXPECT_LT(*std::ranges::max_element(winter.values), 1000);
    expect_advice(doubt(winter), "unit = \"kJ/m2\"");
}

TEST(WeatherUnits, OfFewOrDarkDaysAreNotDoubted) {
    EXPECT_EQ(doubt(changed(sunshine("2021-12-01", 13), 0.1)), "");
    EXPECT_NE(doubt(changed(sunshine("2021-12-01", 14), 0.1)), "");
    EXPECT_EQ(doubt(changed(sunshine("2021-12-01", 30), 0.5)), "");
    EXPECT_EQ(doubt(changed(sunshine("2021-01-01", 365), 0)), "");
}

TEST(WeatherUnits, OfTemperatureAreKnownByRangeSwingAndSeason) {
    const input::RegularSeries year = air("2021-01-01", 365),
                               winter = air("2021-01-01", 31);
    EXPECT_EQ(doubt_of_air(year), "");
    EXPECT_EQ(doubt_of_air(winter), "");
    for (const input::RegularSeries& series : {year, winter}) {
        expect_advice(doubt_of_air(changed(series, 10)), "unit = \"0.1 degC\"");
        expect_advice(doubt_of_air(changed(series, 1, 273.15)), "unit = \"K\"");
        expect_advice(doubt_of_air(changed(series, 1.8, 32)), "unit = \"degF\"");
    }
}

TEST(WeatherUnits, OfOneWrongCellAreNotDoubted) {
    input::RegularSeries year = air("2021-01-01", 365);
    year.values[40] = 212;
    EXPECT_EQ(doubt_of_air(year), "");
}

TEST(WeatherUnits, OfCodesForMissingAreNotDoubted) {
    input::RegularSeries year = air("2021-01-01", 365);
    for (std::size_t k = 40; k < year.values.size(); k += 290) year.values[k] = 99.9;
    EXPECT_EQ(doubt_of_air(year), "");
    expect_advice(doubt_of_air(changed(year, 10)), "unit = \"0.1 degC\"");
}

TEST(WeatherUnits, AreExact) {
    const auto find = [](const std::string& name) {
        return *std::ranges::find_if(
            weather_units(), [&](const WeatherUnit& unit) { return name == unit.name; });
    };
    EXPECT_DOUBLE_EQ(360 * factor_of(find("J/cm2"), 3600), 1000);
    EXPECT_DOUBLE_EQ(3.6 * factor_of(find("MJ/m2"), 3600), 1000);
    EXPECT_DOUBLE_EQ(25 * factor_of(find("Wh/m2"), 900), 100);
    EXPECT_NEAR(1 * factor_of(find("Btu/ft2"), 3600), 3.1546, 1e-4);
    EXPECT_NEAR(1 * factor_of(find("cal/cm2"), 3600), 11.622, 1e-3);
    EXPECT_NEAR(77 * find("degF").factor + find("degF").offset, 25, 1e-12);
}

/// The same value all the time, on so many days.
input::RegularSeries steady(double value, int n_days) {
    input::RegularSeries series = empty("2021-03-01", n_days, 3600);
    series.values.assign(static_cast<std::size_t>(series.axis.n_steps), value);
    return series;
}

TEST(WeatherUnits, HumidityThatNoDesertHasIsAShare) {
    EXPECT_NE(doubt_of_humidity(steady(1, 3)).value_or("").find("unit = \"0 to 1\""),
              std::string::npos);
    EXPECT_FALSE(doubt_of_humidity(steady(1.51, 3)));
    EXPECT_TRUE(doubt_of_humidity(steady(1.5, 3)));
    EXPECT_FALSE(doubt_of_humidity(steady(1, 1)));
}

TEST(WeatherUnits, WindThatNoTownHasIsInAnotherUnit) {
    const std::string said = doubt_of_wind(steady(12.6, 14)).value_or("");
    EXPECT_NE(said.find("Write unit = \"km/h\""), std::string::npos) << said;
    EXPECT_FALSE(doubt_of_wind(steady(9, 14)));
    EXPECT_TRUE(doubt_of_wind(steady(9.01, 14)));
    EXPECT_FALSE(doubt_of_wind(steady(12.6, 13)));
}

}  // namespace
}  // namespace bemcal::checks
