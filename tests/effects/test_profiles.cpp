#include "base/error.hpp"
#include "effects/air.hpp"
#include "effects/drivers.hpp"
#include "effects/levels.hpp"
#include "effects/profiles.hpp"
#include "effects/schedules.hpp"
#include "office.hpp"

#include <set>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;

const Office& office() {
    static const Office one;
    return one;
}

/// The step that begins at this time.
std::size_t at(const char* time, const Office& where = office()) {
    return static_cast<std::size_t>(where.drive.axis.step_of(physics::parse_time(time)));
}

std::vector<double> profile(const Effect& effect, const Office& where = office()) {
    return profile_of(effect, where.around);
}

TEST(Drivers, HaveOneSeriesEach) {
    for (int k = 0; k <= static_cast<int>(Driver::column); ++k) {
        const DriverRow& row = row_of(static_cast<Driver>(k));
        EXPECT_NE(row.of_weather == nullptr, row.of_steps == nullptr) << row.name;
    }
}

TEST(Air, SkyTemperatureInvertsBlackBodyRadiation) {
    EXPECT_NEAR(sky_temperature(5.670374e-8 * std::pow(263.15, 4)), -10, 1e-9);
}

// Under a clear sky the apparent sky is some 10 to 25 K colder, under clouds less.
TEST(Air, CloudsWarmTheSky) {
    const double clear = 15 - sky_temperature(sky_infrared(15, 60, 0));
    const double covered = 15 - sky_temperature(sky_infrared(15, 60, 1));
    EXPECT_GT(clear, 10);
    EXPECT_LT(clear, 25);
    EXPECT_LT(covered, 0.6 * clear);
}

TEST(Air, TheGroundLagsTheOutdoorsAndSwingsLess) {
    const std::vector<double> ground = ground_series(office().weather);
    const auto coldest = std::min_element(ground.begin(), ground.end());
    const auto days = (coldest - ground.begin()) / 24;
    EXPECT_GT(days, 45);  // outdoors: 20 January
    EXPECT_LT(days, 90);
    // A first-order lag of 60 d damps a yearly swing of 11 K to 11 / sqrt(1 + 1.0328^2).
    const double swing = (*std::max_element(ground.begin(), ground.end()) - *coldest) / 2;
    EXPECT_NEAR(swing, 11 / std::sqrt(1 + 1.0328 * 1.0328), 0.25);
}

TEST(Air, AYearOfWhichHalfIsThereHasAMeanOfItsOwn) {
    physics::Weather weather;
    const auto first_of = [&](int n_hours) {
        weather.axis = {physics::parse_time("2022-01-01") - std::chrono::hours(n_hours),
                        3600, n_hours + 8760};
        weather.theta_e.assign(static_cast<std::size_t>(n_hours), 4);
        weather.theta_e.resize(weather.theta_e.size() + 8760, 10);
        const std::vector<double> means = yearly_mean_series(weather);
        EXPECT_NEAR(means.back(), 10, 1e-9);
        return means.front();
    };
    EXPECT_NEAR(first_of(4380), 4, 1e-9);
    EXPECT_NEAR(first_of(4379), (4 * 4379 + 10 * 8760) / (4379 + 8760.0), 1e-9);
}

TEST(Surroundings, WeatherIsLaidOnTheDrivesSteps) {
    const Office half_hours("2021-03-01", "2021-04-01", 1800);
    const std::size_t step = at("2021-03-05 14:30", half_hours);
    const std::size_t hour = 24 * (31 + 28 + 4) + 14;
    EXPECT_EQ(half_hours.around.weather.at(Driver::wind)[step],
              half_hours.weather.wind_speed[hour]);
    EXPECT_EQ(half_hours.around.weather.at(Driver::sun_horizontal)[step],
              half_hours.weather.global_horizontal[hour]);
    EXPECT_EQ(half_hours.around.weather.at(Driver::wind).size(),
              static_cast<std::size_t>(half_hours.drive.n_steps()));
}

TEST(Surroundings, BeforeTheWeatherItsFirstDayRepeats) {
    const Office new_year("2021-01-01", "2021-02-01");
    EXPECT_EQ(new_year.drive.n_warm_up, 14 * 24);
    EXPECT_EQ(new_year.around.weather.at(Driver::wind)[at("2020-12-25 07:00", new_year)],
              new_year.weather.wind_speed[7]);
}

TEST(Surroundings, GapsHoldTheLastValueAndALackIsALack) {
    physics::Weather weather = office().weather;
    weather.wind_speed[24 * 100] = NAN;
    weather.relative_humidity.clear();
    const Surroundings around = make_surroundings(office().building, office().drive,
                                                  weather, office().around.from);
    const std::size_t gap = at("2021-04-11 00:00");
    EXPECT_EQ(around.weather.at(Driver::wind)[gap], weather.wind_speed[24 * 100 - 1]);
    EXPECT_TRUE(around.weather.at(Driver::moisture).empty());
    Effect latent{.name = "latent", .driver = Driver::moisture};
    EXPECT_FALSE(is_known(latent, around));
    EXPECT_TRUE(is_known(latent, office().around));
    EXPECT_THROW(profile_of(latent, around), CannotSimulate);
}

TEST(Surroundings, ATenthOfASeriesMayBeMissing) {
    const physics::TimeAxis& axis = office().weather.axis;
    const int n = office().drive.n_steps(),
              first = axis.step_of(office().drive.axis.begin_of(0));
    ASSERT_GE(first, 0);
    const auto is_known_without = [&](int n_missing) {
        physics::Weather weather = office().weather;
        for (int k = 0; k < n_missing; ++k)
            weather.wind_speed[static_cast<std::size_t>(first + n / 2 + k)] = NAN;
        return !make_surroundings(office().building, office().drive, weather,
                                  office().around.from)
                    .weather.at(Driver::wind)
                    .empty();
    };
    EXPECT_TRUE(is_known_without(n / 10));
    EXPECT_FALSE(is_known_without(n / 10 + 1));
}

TEST(Surroundings, WindTakesSixTenthsOfLeaksAtMost) {
    physics::Weather weather = office().weather;
    weather.wind_speed.assign(weather.wind_speed.size(), 10);
    const std::size_t step = at("2021-03-05 14:00");
    const auto relative = [&](double wind) {
        weather.wind_speed[24 * (31 + 28 + 4) + 14] = wind;
        return make_surroundings(office().building, office().drive, weather,
                                 office().around.from)
            .weather.at(Driver::relative_wind)[step];
    };
    EXPECT_EQ(relative(3.9), -0.6);
    EXPECT_NEAR(relative(4.1), -0.59, 1e-3);
}

TEST(Profiles, TheSunniestWindowsSunIsInStepsOfFifty) {
    const physics::Building& building = office().building;
    physics::Drive drive = office().drive;
    const std::size_t step = at("2021-03-05 14:00");
    for (double& value : drive.irradiance.values) value = 0;
    const auto sun = [&] {
        return profile_of({.driver = Driver::sunniest_window},
                          make_surroundings(building, drive, office().weather,
                                            office().around.from))[step];
    };
    const auto of_window = [&](std::size_t k) -> double& {
        const auto& windows = building.zones[0].windows;
        return drive.irradiance(static_cast<std::size_t>(windows[k].plane), step);
    };
    of_window(0) = 124.9;
    EXPECT_EQ(sun(), 100);
    of_window(0) = 125.1;
    EXPECT_EQ(sun(), 150);
    of_window(1) = 300;
    EXPECT_EQ(sun(), 300);
}

TEST(Profiles, ARoomKeepsSomeOfTheSunThatItHad) {
    const physics::Building& building = office().building;
    physics::Drive drive = office().drive;
    const std::size_t step = at("2021-03-05 14:00");
    for (double& value : drive.irradiance.values) value = 0;
    const auto plane = static_cast<std::size_t>(building.zones[0].windows[0].plane);
    drive.irradiance(plane, step) = 800;
    drive.irradiance(plane, step + 2) = 500;
    const auto sun = profile_of(
        {.driver = Driver::sunniest_room},
        make_surroundings(building, drive, office().weather, office().around.from));
    EXPECT_EQ(sun[step - 1], 0);
    EXPECT_EQ(sun[step], 800);
    EXPECT_EQ(sun[step + 1], 600) << "three quarters of it";
    EXPECT_EQ(sun[step + 2], 500) << "the sun itself, not 450";
    EXPECT_EQ(sun[step + 3], 400) << "375, in steps of fifty";
}

TEST(Profiles, AStartIsTheFirstHourOfASetPoint) {
    Office open;
    physics::Thermostat& control = open.building.zones[0].thermostat;
    control.heating_set_point = {20, 16, 0};
    control.cooling_set_point.profile = -1;
    const std::size_t six = at("2021-03-05 06:00");
    auto hours = open.drive.profiles.row(0);
    std::ranges::fill(hours, 0);
    for (std::size_t hour = 0; hour < 4; ++hour) hours[six + hour] = hour < 2 ? 0.6 : 1;
    Effect effect{.hook = Hook::heating_set_point, .driver = Driver::plant_start};
    const auto starts = profile(effect, open);
    EXPECT_EQ(starts[six - 1], 0);
    EXPECT_DOUBLE_EQ(starts[six], 0.6);
    EXPECT_EQ(starts[six + 1], 0);
    EXPECT_DOUBLE_EQ(starts[six + 2], 0.4) << "it rises once more";
    EXPECT_EQ(starts[six + 4], 0) << "its end is no start";
    effect.hook = Hook::cooling_set_point;
    EXPECT_EQ(std::ranges::max(profile(effect, open)), 0) << "it has no hours";
}

TEST(Profiles, ShapesOfWind) {
    const double wind = office().around.weather.at(Driver::wind)[at("2021-03-05 14:00")];
    const auto value = [&](Shape shape) {
        return profile({.driver = Driver::wind, .shape = shape})[at("2021-03-05 14:00")];
    };
    EXPECT_EQ(value({}), wind);
    EXPECT_EQ(value({Form::above, wind - 1}), wind - (wind - 1));
    EXPECT_EQ(value({Form::above, wind + 1}), 0);
    EXPECT_EQ(value({Form::below, wind + 2}), wind + 2 - wind);
    EXPECT_EQ(value({Form::over, wind - 1}), 1);
    EXPECT_EQ(value({Form::under, wind - 1}), 0);
    EXPECT_EQ(value({Form::within, wind, wind + 1}), 1);
    EXPECT_EQ(value({Form::within, wind - 1, wind}), 0);
}

TEST(Profiles, WindAboutItsMeanIsTheSameInEveryPeriod) {
    const Office spring("2021-03-01", "2021-05-01");
    const auto wind = profile({.driver = Driver::relative_wind});
    const auto in_spring = profile_of({.driver = Driver::relative_wind}, spring.around);
    double sum = 0;
    for (const double value : wind) sum += value;
    EXPECT_NEAR(sum / static_cast<double>(wind.size()), 0, 0.05);
    const auto warm_up = static_cast<std::size_t>(spring.drive.n_warm_up);
    EXPECT_EQ(in_spring[warm_up], wind[at("2021-03-01 00:00")]);
}

TEST(Profiles, HourWindowsGoThroughMidnightAndShareSteps) {
    const auto evening =
        profile({.driver = Driver::hour, .shape = {Form::within, 22, 6}});
    EXPECT_EQ(evening[at("2021-03-05 23:00")], 1);
    EXPECT_EQ(evening[at("2021-03-05 05:00")], 1);
    EXPECT_EQ(evening[at("2021-03-05 06:00")], 0);
    const auto half = profile({.driver = Driver::hour, .shape = {Form::within, 6.5, 8}});
    EXPECT_EQ(half[at("2021-03-05 06:00")], 0.5);
    EXPECT_EQ(half[at("2021-03-05 07:00")], 1);
}

TEST(Profiles, SeasonsGoThroughNewYear) {
    const auto winter =
        profile({.driver = Driver::day_of_year, .shape = {Form::within, 334, 59}});
    EXPECT_EQ(winter[at("2021-02-28 12:00")], 1);
    EXPECT_EQ(winter[at("2021-03-01 00:00")], 0);
    EXPECT_EQ(winter[at("2021-11-30 23:00")], 0);
    EXPECT_EQ(winter[at("2021-12-01 00:00")], 1);
}

TEST(Profiles, GatesOfTheCalendar) {
    const auto gate = [](Gate which) { return profile({.gate = which}); };
    EXPECT_EQ(gate(Gate::weekend)[at("2021-03-06 12:00")], 1);  // a Saturday
    EXPECT_EQ(gate(Gate::weekday)[at("2021-03-06 12:00")], 0);
    EXPECT_EQ(gate(Gate::day)[at("2021-03-06 07:00")], 1);
    EXPECT_EQ(gate(Gate::night)[at("2021-03-06 06:00")], 1);
    EXPECT_EQ(gate(Gate::day)[at("2021-03-06 18:00")], 1);
    EXPECT_EQ(gate(Gate::night)[at("2021-03-06 19:00")], 1);
    EXPECT_EQ(gate(Gate::occupied)[at("2021-03-05 08:00")], 1);
    EXPECT_EQ(gate(Gate::unoccupied)[at("2021-03-06 12:00")], 1);
    EXPECT_EQ(gate(Gate::heating_season)[at("2021-02-01 12:00")], 1);
    EXPECT_EQ(gate(Gate::heating_season)[at("2021-07-20 12:00")], 0);
    EXPECT_EQ(gate(Gate::cooling_season)[at("2021-07-20 12:00")], 1);
}

TEST(Profiles, SeasonsAreByAWeeksMean) {
    Office one;
    const auto is_open = [&](Gate gate, double theta_e) {
        one.drive.theta_e.assign(one.drive.theta_e.size(), theta_e);
        return profile({.gate = gate}, one).back() == 1;
    };
    EXPECT_TRUE(is_open(Gate::heating_season, 11.9));
    EXPECT_FALSE(is_open(Gate::heating_season, 12.1));
    EXPECT_FALSE(is_open(Gate::cooling_season, 15.9));
    EXPECT_TRUE(is_open(Gate::cooling_season, 16.1));
}

TEST(Profiles, WeekdayAndHoursNarrowTheGate) {
    Effect saturday_morning;
    saturday_morning.weekday = 5;
    saturday_morning.hours = {8, 12.5};
    const auto open = profile(saturday_morning);
    EXPECT_EQ(open[at("2021-03-06 08:00")], 1);
    EXPECT_EQ(open[at("2021-03-06 12:00")], 0.5);
    EXPECT_EQ(open[at("2021-03-06 13:00")], 0);
    EXPECT_EQ(open[at("2021-03-05 09:00")], 0);
}

TEST(Profiles, OnDaysOfOneYearOrEvery) {
    const auto day = [](const char* date) {
        return static_cast<int>(physics::parse_time(date).time_since_epoch().count() /
                                86400);
    };
    Effect closed{.gate = Gate::on_days};
    closed.days = {{day("2021-05-03"), day("2021-05-04"), false},
                   {day("2020-12-20"), day("2021-01-20"), true}};
    const auto open = profile(closed);
    EXPECT_EQ(open[at("2021-05-03 00:00")], 1);
    EXPECT_EQ(open[at("2021-05-04 23:00")], 1);
    EXPECT_EQ(open[at("2021-05-05 00:00")], 0);
    EXPECT_EQ(open[at("2021-12-25 00:00")], 1);
    EXPECT_EQ(open[at("2021-01-20 23:00")], 1);
    EXPECT_EQ(open[at("2021-01-21 00:00")], 0);
}

TEST(Profiles, ElapsedCountsYearsFromTheBeginOfTraining) {
    const auto years = profile({.driver = Driver::elapsed});
    EXPECT_EQ(years[at("2021-01-15 00:00")], 0);
    EXPECT_NEAR(years[at("2021-12-15 00:00")], 334 / 365.25, 1e-12);
    EXPECT_LT(years[0], 0);
}

TEST(Profiles, OccupationIsAShareOfItsLargest) {
    const auto people = profile({.driver = Driver::occupied});
    EXPECT_EQ(people[at("2021-03-05 09:00")], 1);
    EXPECT_NEAR(people[at("2021-03-05 12:00")], 0.73, 1e-12);
    EXPECT_NEAR(people[at("2021-03-05 03:00")], 0.1, 1e-12);
}

TEST(Profiles, ALagFollowsAStepAsAnExponential) {
    const Effect lagged{.driver = Driver::elapsed, .shape = {Form::lagged, 240}};
    // Of a ramp, once it has settled, the lagged one is the same ramp one lag later.
    const auto years = profile({.driver = Driver::elapsed});
    const std::size_t late = years.size() - 1;
    const double lag_h = (years[late] - profile(lagged)[late]) * 365.25 * 24;
    EXPECT_NEAR(lag_h, 240, 1);
}

TEST(Profiles, LevelsKeepZerosAndTheMean) {
    const std::vector<double> wind =
        profile({.driver = Driver::wind, .shape = {Form::above, 3}});
    const std::vector<double> few = levelled(wind, 24);
    EXPECT_LE(std::set<double>(few.begin(), few.end()).size(), 24u);
    EXPECT_NEAR(test::total(few), test::total(wind), 1e-8);
    const auto [least, most] = std::minmax_element(wind.begin(), wind.end());
    for (std::size_t k = 0; k < wind.size(); ++k) {
        EXPECT_LE(std::abs(few[k] - wind[k]), (*most - *least) / 23);
        if (wind[k] == 0) {
            EXPECT_EQ(few[k], 0);
        }
    }
}

TEST(Profiles, LevelsLeaveFewValuesAlone) {
    const std::vector<double> few = {0, 1, 0.3, 1, 0};
    EXPECT_EQ(levelled(few, 3), few);
}

TEST(Schedules, AScheduleRepeatsAndASeriesDoesNot) {
    const physics::Drive& drive = office().drive;
    EXPECT_TRUE(is_schedule(drive.profiles.row(test::office_hours_row), drive));
    EXPECT_TRUE(is_schedule(drive.profiles.row(test::night_row), drive));
    EXPECT_FALSE(is_schedule(office().around.weather.at(Driver::wind), drive));
}

TEST(Schedules, SevenTenthsOfTheStepsRepeat) {
    const physics::Drive& drive = office().drive;
    const int n = drive.n_steps() - drive.n_warm_up - 7 * 24;  // that have a week before
    const auto is_one_without = [&](int n_others) {
        std::vector<double> row(static_cast<std::size_t>(drive.n_steps()), 0.0);
        for (int k = 1; k <= n_others; ++k)
            row[row.size() - static_cast<std::size_t>(k)] = k;
        return is_schedule(row, drive);
    };
    EXPECT_TRUE(is_one_without(3 * n / 10));
    EXPECT_FALSE(is_one_without(3 * n / 10 + 1));
}

TEST(Schedules, AnotherDayPassesOverClosedDays) {
    const physics::Drive& drive = office().drive;
    const auto own = drive.profiles.row(test::office_hours_row);
    const std::vector<double> sunday = as_on(6, own, drive);
    EXPECT_EQ(*std::max_element(sunday.begin(), sunday.end()), 0);
    const std::vector<double> friday = as_on(4, own, drive);
    EXPECT_EQ(friday[at("2021-12-25 09:00")], 1);  // 24 December, a Friday, is closed
    EXPECT_EQ(friday[at("2021-03-07 12:00")], 0.7);
    EXPECT_EQ(friday[at("2021-03-07 18:00")], 0);
}

// A held-out period may be a few days; what moves schedules in training moves them there.
TEST(Schedules, OfAFewDaysAreSchedulesTooByTheDaysBefore) {
    physics::Drive drive = office().drive;
    drive.n_warm_up = drive.n_steps() - 5 * 24;
    const auto own = drive.profiles.row(test::office_hours_row);
    EXPECT_TRUE(is_schedule(own, drive));
    EXPECT_FALSE(is_schedule(office().around.weather.at(Driver::wind), drive));
    for (int weekday = 0; weekday < 7; ++weekday) {
        const std::vector<double> other = as_on(weekday, own, drive);
        const auto last = std::span(other).last(5 * 24);
        EXPECT_EQ(*std::ranges::max_element(last), weekday < 5 ? 1 : 0) << weekday;
    }
}

TEST(Schedules, LaterByHoursIsLinearBetweenSteps) {
    const physics::Drive& drive = office().drive;
    const auto own = drive.profiles.row(test::office_hours_row);
    const std::vector<double> later = later_by(1, own, drive);
    EXPECT_EQ(later[at("2021-03-05 08:00")], 0);
    EXPECT_EQ(later[at("2021-03-05 18:00")], 1);
    const std::vector<double> earlier = later_by(-0.5, own, drive);
    EXPECT_EQ(earlier[at("2021-03-05 07:00")], 0.5);
    EXPECT_EQ(earlier[at("2021-03-05 08:00")], 1);
    EXPECT_EQ(earlier[at("2021-03-05 17:00")], 0.5);
}

TEST(Sentences, SayDriverShapeAndGate) {
    Effect effect{.driver = Driver::wind, .shape = {Form::above, 3}, .gate = Gate::night};
    EXPECT_EQ(sentence_of(effect), "wind above 3 m/s, at night");
    effect = {.driver = Driver::hour, .shape = {Form::within, 18, 21}, .weekday = 5};
    EXPECT_EQ(sentence_of(effect), "from 18 to 21 h, on Saturdays");
    effect = {.driver = Driver::day_of_year, .shape = {Form::within, 120, 243}};
    EXPECT_EQ(sentence_of(effect), "from 1 May to 1 September");
    effect = {.hook = Hook::operation,
              .driver = Driver::another_day,
              .shape = {Form::linear, 6}};
    EXPECT_EQ(sentence_of(effect), "as on Sunday");
    EXPECT_EQ(unit_of(Effect{.hook = Hook::infiltration, .driver = Driver::wind}),
              "1/h per m/s");
}

}  // namespace
}  // namespace bemcal::effects
