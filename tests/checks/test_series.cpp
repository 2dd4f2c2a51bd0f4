#include "checks/data_clock.hpp"
#include "checks/made_meters.hpp"
#include "checks/series.hpp"
#include "input/units.hpp"
#include "job/small_office.hpp"
#include "physics/sun.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using physics::Quantity;

constexpr int day = 24;

input::RegularSeries electricity(std::uint64_t seed = 5, int n_days = 365) {
    input::RegularSeries series;
    series.axis = {physics::parse_time("2021-01-04"), 3600, n_days * day};
    series.values = stats::made_electricity(seed, n_days).values;
    return series;
}

void fill(input::RegularSeries& series, int first, int n, double value) {
    std::fill_n(series.values.begin() + first, n, value);
}

void scale_from(input::RegularSeries& series, int from, double factor) {
    for (std::size_t k = static_cast<std::size_t>(from); k < series.values.size(); ++k)
        series.values[k] *= factor;
}

TEST(DataChecks, OfStepsThatDoNotDivideADayNothingIsFound) {
    for (const int step_s : {7 * 3600, 8785 * 3600}) {
        input::RegularSeries series = electricity();
        series.axis.step_s = step_s;
        fill(series, 100 * day, 30, 0);
        EXPECT_TRUE(checks::check_series(series, Quantity::electricity, {}).empty());
    }
}

TEST(DataChecks, ZerosThatMeanMissingAreMaskedWithDatesAndNumbers) {
    input::RegularSeries series = electricity();
    fill(series, 100 * day, 30, 0);
    const auto found = checks::check_series(series, Quantity::electricity, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].finding,
              "1 run of zeros where it is well above 0 at the same hours of the days "
              "around, 30 h in all; the longest: 30 h from 2021-04-14 00:00:00");
    EXPECT_EQ(found[0].action, "masked; zeros = \"keep\" would keep them");
    EXPECT_TRUE(std::isnan(series.values[100 * day + 29]));
    EXPECT_FALSE(std::isnan(series.values[100 * day + 30]));
}

TEST(DataChecks, KeepOverrulesEachOfThem) {
    input::RegularSeries series = electricity();
    fill(series, 50 * day, 30, 0);
    fill(series, 100 * day, 30, 123.4);
    scale_from(series, 200 * day, 10);
    const std::vector<double> before = series.values;
    const checks::CheckOptions keep{checks::Handling::keep, checks::Handling::keep,
                                    checks::StepHandling::keep};
    const auto found = checks::check_series(series, Quantity::electricity, keep);
    EXPECT_EQ(series.values, before);
    ASSERT_EQ(found.size(), 3U);
    for (const checks::Finding& finding : found)
        EXPECT_TRUE(finding.action.starts_with("kept")) << finding.action;
}

TEST(DataChecks, AFillIsMaskedAndAShortRunIsNot) {
    input::RegularSeries series = electricity();
    fill(series, 100 * day, 20, 123.4);
    fill(series, 150 * day, 6, 124.4);
    const auto found = checks::check_series(series, Quantity::electricity, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(std::isnan(series.values[100 * day + 19]));
    EXPECT_EQ(series.values[150 * day], 124.4);
}

TEST(DataChecks, HeatingThatIsOffInSummerIsStatedAndKept) {
    input::RegularSeries series = electricity(5, 730);
    series.values = stats::made_heat(3, 730).values;
    const auto found = checks::check_series(series, Quantity::heating, {});
    for (const checks::Finding& finding : found)
        EXPECT_TRUE(finding.action.starts_with("kept")) << finding.finding;
    for (const double value : series.values) EXPECT_FALSE(std::isnan(value));
}

TEST(DataChecks, AStepOfTheUnitIsBroughtToTheLongerStretch) {
    const input::RegularSeries clean = electricity();
    input::RegularSeries series = clean;
    scale_from(series, 300 * day, 1 / 3.6);
    const auto found = checks::check_series(series, Quantity::electricity, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NE(found[0].finding.find("near the 3.6 of MJ and kWh"), std::string::npos)
        << found[0].finding;
    EXPECT_NE(found[0].action.find("scaled by 3.6"), std::string::npos)
        << found[0].action;
    for (std::size_t k = 0; k < series.values.size(); ++k)
        if (k < 300 * day - 3 || k > 300 * day + 3) {
            ASSERT_NEAR(series.values[k], clean.values[k], 1e-9) << k;
        }
}

TEST(DataChecks, AStepNearNoRatioOfUnitsIsKept) {
    input::RegularSeries series = electricity();
    scale_from(series, 200 * day, 6);
    const std::vector<double> before = series.values;
    const auto found = checks::check_series(series, Quantity::electricity, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NE(found[0].finding.find("near no known ratio"), std::string::npos);
    EXPECT_EQ(series.values, before);
}

// A step of the meter's scale that the search of effects is to find.
TEST(DataChecks, AQuarterMoreIsNotTouched) {
    input::RegularSeries series = electricity();
    scale_from(series, 200 * day, 1.25);
    EXPECT_TRUE(checks::check_series(series, Quantity::electricity, {}).empty());
}

/// A building at 52 N with one electricity meter and nothing declared.
study::Case building_with(const input::RegularSeries& series) {
    study::Case building;
    building.name = "office";
    building.weather.site = {52, 10, 1};
    building.meters.push_back({"elec", Quantity::electricity, physics::Interval::hourly,
                               series.axis, series.values});
    return building;
}

/// The readings of a building that follows the EU's summer time, in standard time.
input::RegularSeries on_wall_clock() {
    input::RegularSeries series = electricity(3);
    const std::vector<double> before = series.values;
    for (std::size_t k = 0; k + 1 < before.size(); ++k)
        if (physics::is_summer_time(series.axis.begin_of(static_cast<int>(k)), "eu", 1))
            series.values[k] = before[k + 1];
    return series;
}

physics::Profile schedule_with(const char* summer_time) {
    physics::Profile profile;
    profile.schedule.summer_time = summer_time;
    for (std::size_t weekday = 0; weekday < 5; ++weekday)
        for (std::size_t hour = 8; hour < 18; ++hour)
            profile.schedule.week[weekday][hour] = 1;
    return profile;
}

TEST(ClockChecks, SummerTimeThatNoScheduleDeclaresIsStated) {
    study::Case building = building_with(on_wall_clock());
    checks::check_clocks(building);
    ASSERT_EQ(building.decisions.size(), 1U);
    EXPECT_NE(building.decisions[0].finding.find("h at 2021-03-28"), std::string::npos)
        << building.decisions[0].finding;
    EXPECT_EQ(building.decisions[0].action,
              "kept; schedules with summer_time = \"eu\" would follow");
    building = building_with(on_wall_clock());
    building.profiles.push_back(schedule_with("eu"));
    checks::check_clocks(building);
    EXPECT_TRUE(building.decisions.empty());
}

TEST(ClockChecks, StampsThatStandWhereTheSchedulesMoveAreStated) {
    study::Case building = building_with(electricity(3));
    checks::check_clocks(building);
    EXPECT_TRUE(building.decisions.empty());
    building.profiles.push_back(schedule_with("eu"));
    checks::check_clocks(building);
    ASSERT_EQ(building.decisions.size(), 1U);
    EXPECT_EQ(building.decisions[0].action,
              "kept; clock = \"eu\" would read its stamps as wall clock");
}

TEST(ClockChecks, DaysBehindTheDeclaredLoadsAreStated) {
    input::RegularSeries series = electricity(3);
    study::Case building = building_with(series);
    building.weather.site = {};  // no summer time there
    building.profiles.push_back(schedule_with("none"));
    physics::Profile& hours = building.profiles[0];
    const auto measured = checks::weekday_profile(
        checks::data_series(series.values, series.axis, Quantity::electricity), 0,
        series.axis.n_steps);
    const double half =
        (*std::ranges::max_element(measured) + *std::ranges::min_element(measured)) / 2;
    for (std::size_t hour = 0; hour < 24; ++hour)  // declared two hours too early
        for (std::size_t weekday = 0; weekday < 5; ++weekday)
            hours.schedule.week[weekday][hour] = measured[(hour + 2) % 24] > half ? 1 : 0;
    physics::Load load;
    load.density = {10, 2, 0};
    load.carrier = physics::Carrier::electricity;
    building.building.zones.emplace_back();
    building.building.zones[0].floor_area = 100;
    building.building.zones[0].loads.push_back(load);
    checks::check_clocks(building);
    ASSERT_EQ(building.decisions.size(), 1U);
    EXPECT_NE(building.decisions[0].finding.find("2.0"), std::string::npos)
        << building.decisions[0].finding;
    EXPECT_NE(building.decisions[0].finding.find("behind the declared"),
              std::string::npos);
}

TEST(ClockChecks, AShiftThatRoundsToNothingHasNoSign) {
    for (std::uint64_t seed = 1; seed < 40; ++seed) {
        input::RegularSeries series = electricity(seed);
        for (std::size_t k = 7 * day; k < series.values.size(); ++k)  // every week alike
            series.values[k] = series.values[k - 7 * day] + 1e-9 * static_cast<double>(k);
        study::Case building = building_with(series);
        building.profiles.push_back(schedule_with("eu"));
        checks::check_clocks(building);
        for (const study::DataDecision& decision : building.decisions)
            EXPECT_EQ(decision.finding.find("-0.00 h"), std::string::npos)
                << decision.finding;
    }
}

TEST(ClockChecks, SunshineAnHourBehindTheSunIsStated) {
    study::Case building;
    building.weather.site = {52, 10, 1};
    building.weather.axis = {physics::parse_time("2021-01-01"), 3600, 365 * day};
    const auto suns = physics::step_suns(building.weather.site, building.weather.axis,
                                         physics::SunOfStep::sunlit_part);
    std::vector<double>& global = building.weather.global_horizontal;
    for (const physics::StepSun& sun : suns)
        global.push_back(sun.sunlit * 900 * std::max(std::cos(sun.position.zenith), 0.0));
    checks::check_weather_clock(building);
    EXPECT_TRUE(building.decisions.empty());
    std::rotate(global.begin(), global.end() - 1, global.end());
    checks::check_weather_clock(building);
    ASSERT_EQ(building.decisions.size(), 1U);
    EXPECT_NE(building.decisions[0].finding.find("h behind the sun"), std::string::npos)
        << building.decisions[0].finding;
}

TEST(SharedMeters, AreStatedAtBothAndNeverChanged) {
    const input::RegularSeries series = electricity(0);
    input::RegularSeries share = series;
    scale_from(share, 0, 0.25);
    std::vector<study::Case> buildings{building_with(series), building_with(share),
                                       building_with(electricity(6))};
    buildings[1].name = "annex";
    checks::check_shared_meters(buildings);
    ASSERT_EQ(buildings[0].decisions.size(), 1U);
    ASSERT_EQ(buildings[1].decisions.size(), 1U);
    EXPECT_TRUE(buildings[2].decisions.empty());
    EXPECT_TRUE(buildings[0].decisions[0].finding.starts_with(
        "shared with elec of annex: 4 times its reading"))
        << buildings[0].decisions[0].finding;
    EXPECT_EQ(buildings[1].meters[0].values, share.values);
}

TEST(SharedMeters, OfManyBuildingsAreStatedOnceAtEach) {
    std::vector<study::Case> buildings;
    for (int k = 0; k < 14; ++k) {
        input::RegularSeries share = electricity(0);
        scale_from(share, 0, 1 + k);
        buildings.push_back(building_with(share));
        buildings.back().name = fmt::format("house {}", k);
    }
    checks::check_shared_meters(buildings);
    for (const study::Case& building : buildings)
        EXPECT_EQ(building.decisions.size(), 1U);
    EXPECT_TRUE(buildings[5].decisions[0].finding.starts_with(
        "shared with elec of house 0 and 12 more: 6 times its reading"))
        << buildings[5].decisions[0].finding;
}

/// The decisions of the sample job with a day of zeros in its electricity.
std::vector<study::DataDecision> decisions_with(const std::string& lines) {
    const Folder folder;
    const auto file = write_small_office(
        folder,
        replaced(small_office_text(), "unit = \"kWh\"", "unit = \"kWh\"\n" + lines));
    std::string text = "time,elec_kWh,T_air_C\n";
    for (int k = 0; k < 59 * day; ++k)
        text += fmt::format("{},{},{}\n",
                            physics::format_time(physics::parse_time("2021-01-01") +
                                                 std::chrono::hours(k + 1)),
                            k >= 500 && k < 530 ? 0.0 : 5.0 + k % 7, 20 + k % 5);
    folder.write("measured.csv", text);
    return read_job(file).buildings[0].decisions;
}

TEST(DataChecks, StandInTheJobsDecisionsAndItsKeysOverruleThem) {
    const auto action = [](const std::vector<study::DataDecision>& decisions) {
        for (const auto& decision : decisions)
            if (decision.finding.find("zeros") != std::string::npos)
                return decision.action;
        return std::string();
    };
    EXPECT_EQ(action(decisions_with("")), "masked; zeros = \"keep\" would keep them");
    EXPECT_EQ(action(decisions_with("zeros = \"keep\"")),
              "kept; zeros = \"missing\" would mask them");
    EXPECT_EQ(action(decisions_with("zeros = \"missing\"")), "masked");
    EXPECT_THROW(decisions_with("zeros = \"mask\""), UserError);
    EXPECT_THROW(decisions_with("steps = \"correct\""), UserError);
}

TEST(Units, CubicMetresAndHundredsOfCubicFeetOfGasAreTheKnownFactors) {
    EXPECT_NEAR(input::find_unit("m3")->factor, 11.2, 0.05);
    EXPECT_NEAR(input::find_unit("100 ft3")->factor, 31.7, 0.1);
    // ENERGY STAR Portfolio Manager, Thermal Energy Conversions: 1 ccf = 102.6 kBtu.
    EXPECT_NEAR(input::find_unit("CCF")->factor, 102.6 * 0.29307107, 1e-6);
    EXPECT_NEAR(input::find_unit("therm")->factor, 29.3071, 1e-4);  // 100,000 Btu
    EXPECT_NEAR(77 * input::find_unit("degF")->factor + input::find_unit("degF")->offset,
                25, 1e-12);
    EXPECT_EQ(input::find_unit("kwh"), nullptr);
}

}  // namespace
}  // namespace bemcal::job
