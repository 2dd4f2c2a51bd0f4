#include "base/error.hpp"
#include "effects/catalogue.hpp"
#include "effects/decisions.hpp"
#include "effects/hooks.hpp"
#include "effects/profiles.hpp"
#include "office.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;
using test::Quantity;
using test::raised;
using test::shown;
using test::total;

const Office& office() {
    static const Office one;
    return one;
}

Placed placed(const Effect& effect, const Office& where = office()) {
    return place(std::span(&effect, 1), where.around);
}

double heating(const Effect& effect, double coefficient) {
    return raised(office(), effect, coefficient, Quantity::heating);
}
double cooling(const Effect& effect, double coefficient) {
    return raised(office(), effect, coefficient, Quantity::cooling);
}

const double before_heating =
    total(shown({office().building, office().drive, {}}, {}, Quantity::heating));

/// One of each hook, as drivers can move it.
std::vector<Effect> one_of_each() {
    std::vector<Effect> all;
    for (const HookRow& row : hook_rows()) {
        Effect effect{.name = row.name, .hook = row.hook};
        if (row.kind == physics::ChangeKind::schedule)
            effect.driver = Driver::another_day;
        if (effect.hook == Hook::neighbour) effect.driver = Driver::ground;
        if (row.is_at_a_meter) effect.meter = Quantity::gas;
        all.push_back(effect);
    }
    return all;
}

TEST(Placement, CoefficientsOfZeroGiveTheSameBits) {
    const auto without =
        test::all_shown(Placed{office().building, office().drive, {}}, {});
    for (const Effect& effect : one_of_each())
        EXPECT_EQ(test::all_shown(placed(effect), {0}), without) << effect.name;
}

TEST(Placement, EveryHookMovesSomeMeter) {
    const auto without =
        test::all_shown(Placed{office().building, office().drive, {}}, {});
    for (const Effect& effect : one_of_each()) {
        const bool switches = effect.hook == Hook::heating_available ||
                              effect.hook == Hook::cooling_available;
        const auto with = test::all_shown(placed(effect), {switches ? -0.9 : 0.1});
        double moved = 0;
        for (std::size_t meter = 0; meter < with.size(); ++meter)
            moved += std::abs(total(with[meter]) - total(without[meter]));
        EXPECT_GT(moved, 1) << effect.name;
    }
}

TEST(Placement, AShiftOfOutdoorAirIsAnotherWeather) {
    const Effect island{.name = "island", .hook = Hook::outdoor_air};
    Placed warmer{office().building, office().drive, {}};
    for (double& theta : warmer.drive.theta_e) theta += 1.5;
    for (const Quantity quantity : {Quantity::gas, Quantity::electricity}) {
        const auto shifted = shown(placed(island), {1.5}, quantity);
        const auto expected = shown(warmer, {}, quantity);
        for (std::size_t k = 0; k < expected.size(); ++k)
            ASSERT_NEAR(shifted[k], expected[k], 1e-9);
    }
}

TEST(Placement, OutdoorAirIsTheSumOfItsThreeWays) {
    std::vector<Effect> ways;
    for (const Hook hook :
         {Hook::supply_air, Hook::opaque_boundary, Hook::window_boundary})
        ways.push_back({.name = name_of(hook), .hook = hook});
    const Effect whole{.name = "whole", .hook = Hook::outdoor_air};
    const auto three = shown(place(ways, office().around), {2, 2, 2}, Quantity::heating);
    EXPECT_EQ(three, shown(placed(whole), {2}, Quantity::heating));
    for (const Effect& way : ways) EXPECT_LT(heating(way, 2), -1) << way.name;
}

/// The office's set-back at other hours, in a drive that numbers its hours in a third
/// row.
struct OfficeWithOtherHours {
    OfficeWithOtherHours() {
        const OtherHours other{"set-back", test::night_row, 2, 0, 1, hours, declared};
        effect = with_hours(other);
        around.drive = &drive;
    }
    static physics::Drive drive_with(const physics::Profile& night) {
        physics::Profile numbered = night;
        numbered.schedule = physics::numbered_hours(night.schedule);
        return physics::make_drive(office().weather, office().building,
                                   {test::office_profile(), night, numbered},
                                   physics::parse_time("2021-01-15"),
                                   physics::parse_time("2021-12-31"), 3600, 14 * 24);
    }
    physics::WeekHours hours = {{{7, 20}, {9, 12}, {}}},
                       declared = {{{6, 22}, {6, 22}, {6, 22}}};
    physics::Drive drive = drive_with(test::night_profile());
    Surroundings around = office().around;
    Effect effect;
};

TEST(Placement, OtherHoursAreTheScheduleOfAllThatFollowsIt) {
    const OfficeWithOtherHours with;
    physics::Profile right = test::night_profile();
    physics::set_hours(with.hours, right.schedule);
    const physics::Drive other = OfficeWithOtherHours::drive_with(right);
    const Placed moved = place(std::span(&with.effect, 1), with.around);
    EXPECT_TRUE(std::ranges::equal(moved.drive.profiles.row(test::night_row),
                                   other.profiles.row(test::night_row)));
    EXPECT_EQ(test::all_shown(moved, {1}),
              test::all_shown(Placed{office().building, other, {}}, {}));
    // They are there or not.
    EXPECT_EQ(moved.parameters.at(0).least, 1);
    EXPECT_EQ(moved.parameters.at(0).most, 1);
    // What else moves the schedule moves these hours: closed, it is as on Sunday.
    const int monday = static_cast<int>(
        physics::parse_time("2021-02-01").time_since_epoch().count() / 86400);
    const Placed closed =
        place(std::vector{with.effect, closed_days({{monday, monday}})}, with.around);
    physics::Building building = closed.building;
    physics::apply(closed.building, closed.parameters, std::vector{1.0, 1.0}, building);
    const int step = closed.drive.axis.step_of(physics::parse_time("2021-02-01 10:00"));
    EXPECT_EQ(closed.drive.at(building.zones[0].thermostat.heating_set_point, step), 16);
    EXPECT_EQ(closed.drive.at(building.zones[0].thermostat.heating_set_point, step + 24),
              21);
}

TEST(Placement, OtherHoursAreSaidWhereTheyAreOthers) {
    OfficeWithOtherHours with;
    EXPECT_EQ(
        sentence_of(with.effect),
        "set-back runs Monday to Friday 7 to 20 h, Saturdays 9 to 12 h, Sundays and "
        "holidays off; declared 6 to 22 h, 6 to 22 h, 6 to 22 h");
    Effect other = with.effect;
    EXPECT_TRUE(are_equal(with.effect, other));
    other.other_hours->hours[0] = {6, 22};
    EXPECT_FALSE(are_equal(with.effect, other));
    EXPECT_EQ(
        sentence_of(other),
        "set-back runs Saturdays 9 to 12 h, Sundays and holidays off; declared 6 to "
        "22 h, 6 to 22 h");
}

TEST(Placement, ManyEffectsAtOneInputAreTheirSum) {
    const Effect leak{.name = "leak", .hook = Hook::infiltration};
    const std::vector<Effect> seven(7, leak);
    const auto parts = shown(place(seven, office().around),
                             std::vector<double>(7, 0.0625), Quantity::heating);
    EXPECT_EQ(parts, shown(placed(leak), {7 * 0.0625}, Quantity::heating));
}

TEST(Placement, WindInfiltrationRaisesHeatingWhenItIsWindy) {
    const Effect windy{
        .name = "wind", .hook = Hook::infiltration, .driver = Driver::wind};
    const auto with = shown(placed(windy), {0.1}, Quantity::heating);
    const auto without = shown(placed(windy), {0}, Quantity::heating);
    const auto warm_up = static_cast<std::size_t>(office().drive.n_warm_up);
    double at_wind = 0, at_calm = 0, asked_wind = 0, asked_calm = 0;
    for (std::size_t k = 0; k < with.size(); ++k) {
        const double theta_e = office().drive.theta_e[warm_up + k];
        if (without[k] <= 0 || theta_e > 5) continue;
        const double wind = office().around.weather.at(Driver::wind)[warm_up + k];
        const bool blows = wind > 5;
        (blows ? at_wind : at_calm) += with[k] - without[k];
        (blows ? asked_wind : asked_calm) += wind * (20 - theta_e);
    }
    EXPECT_GT(at_calm, 0);
    EXPECT_NEAR((at_wind / at_calm) / (asked_wind / asked_calm), 1, 0.25);
}

TEST(Placement, InfiltrationEntersTheFlowOfThatNameOrANewOne) {
    const Effect leak{.name = "leak", .hook = Hook::infiltration};
    const Placed named = placed(leak);
    EXPECT_EQ(named.parameters[0].targets[0].inner, 0);
    EXPECT_EQ(named.building.zones[0].flows.size(), 2u);
    Office tight;
    tight.building.zones[0].flows.erase(tight.building.zones[0].flows.begin());
    const Placed added = placed(leak, tight);
    EXPECT_EQ(added.building.zones[0].flows.size(), 2u);
    EXPECT_EQ(shown(added, {0.4}, Quantity::gas),
              shown({office().building, office().drive, {}}, {}, Quantity::gas));
}

TEST(Placement, WindMovesInfiltrationAboutWhatItIs) {
    const Effect leakage{
        .name = "by wind", .hook = Hook::leakage, .driver = Driver::relative_wind};
    const Placed with = placed(leakage);
    EXPECT_EQ(with.parameters[0].targets.size(), 1u);
    const Effect more{.name = "more", .hook = Hook::leakage};
    EXPECT_GT(heating(more, 0.5), 100);
    EXPECT_LT(std::abs(heating(leakage, 0.5)), 0.2 * heating(more, 0.5));
    Office tight;
    tight.building.zones[0].flows.erase(tight.building.zones[0].flows.begin());
    EXPECT_THROW(placed(leakage, tight), CannotSimulate);
}

TEST(Placement, AGroundMayKeepTheYearlyMean) {
    const Effect keeps{
        .name = "ground", .hook = Hook::ground, .driver = Driver::yearly_mean};
    const std::vector<double>& theta_e = office().weather.theta_e;
    Placed constant{office().building, office().drive, {}};
    constant.building.boundaries[0].temperature = {
        total(theta_e) / static_cast<double>(theta_e.size()), 0, -1};
    const auto moved = shown(placed(keeps), {1}, Quantity::gas),
               expected = shown(constant, {}, Quantity::gas);
    for (std::size_t k = 0; k < expected.size(); ++k)
        ASSERT_NEAR(moved[k], expected[k], 1e-9);
}

TEST(Placement, ANeighbourWhoFollowsTheHourIsNoGround) {
    Office neighbour;
    neighbour.building.boundaries[0].temperature = {20, 16, test::night_row};
    EXPECT_THROW(placed({.name = "ground", .hook = Hook::ground}, neighbour),
                 CannotSimulate);
}

// Levels of two years differ, but for the least.
TEST(Placement, LeaksAreAsSmallInEveryYear) {
    const Effect leakage{
        .name = "by wind", .hook = Hook::leakage, .driver = Driver::relative_wind};
    const auto least_in = [&](const char* from, const char* to) {
        const Office office(from, to);
        const Placed with = placed(leakage, office);
        const auto row = with.drive.profiles.row(with.drive.profiles.rows - 1);
        return std::ranges::min(row);
    };
    const double declared = office().building.zones[0].flows[0].air_change.value;
    EXPECT_DOUBLE_EQ(least_in("2021-01-15", "2021-06-30"), -0.6 * declared);
    EXPECT_DOUBLE_EQ(least_in("2021-07-01", "2021-12-31"), -0.6 * declared);
}

TEST(Placement, MoreRecoveryLessHeatMoreVentilationMoreHeat) {
    EXPECT_LT(heating({.name = "recovery", .hook = Hook::heat_recovery}, 0.5), -100);
    EXPECT_GT(heating({.name = "fans", .hook = Hook::ventilation}, 0.5), 100);
}

TEST(Placement, OpeningsTakeCoolingAway) {
    Effect opening{.name = "windows", .hook = Hook::venting};
    opening.shape.at = 23;
    EXPECT_LT(cooling(opening, 3), -50);
    EXPECT_EQ(placed(opening).building.zones[0].venting.opens_above, 23);
    EXPECT_EQ(placed(opening).parameters[0].least, 0);
}

TEST(Placement, ConductancesRaiseHeating) {
    EXPECT_GT(heating({.name = "walls", .hook = Hook::opaque_conductance}, 0.2), 100);
    EXPECT_GT(heating({.name = "panes", .hook = Hook::window_conductance}, 0.2), 100);
}

TEST(Placement, AFactorOnWallsIsAFactorOnTheirUValues) {
    const Effect walls{.name = "walls", .hook = Hook::opaque_conductance};
    Placed thinner{office().building, office().drive, {}};
    for (physics::Construction& wall : thinner.building.constructions)
        wall.u_value.value *= 1.25;
    EXPECT_EQ(shown(placed(walls), {0.25}, Quantity::gas),
              shown(thinner, {}, Quantity::gas));
}

TEST(Placement, AColdNeighbourCostsHeatAWarmOneBringsIt) {
    Effect neighbour{.name = "neighbour",
                     .hook = Hook::neighbour,
                     .driver = Driver::constant_temperature};
    neighbour.shape.at = 10;
    EXPECT_GT(heating(neighbour, 0.1), 100);
    neighbour.shape.at = 28;
    EXPECT_LT(heating(neighbour, 0.1), -100);
    const Effect ground{
        .name = "ground", .hook = Hook::neighbour, .driver = Driver::ground};
    EXPECT_GT(heating(ground, 0.1), 100);
}

TEST(Placement, ASecondMassSmoothsAndKeepsTheSum) {
    const Effect mass{.name = "mass", .hook = Hook::second_mass};
    const auto with = shown(placed(mass), {0.5}, Quantity::heating);
    const auto without = shown(placed(mass), {0}, Quantity::heating);
    EXPECT_NEAR(total(with), total(without), 0.15 * total(without));
    double apart = 0;
    for (std::size_t k = 0; k < with.size(); ++k) apart += std::abs(with[k] - without[k]);
    EXPECT_GT(apart, 0.05 * total(without));
}

TEST(Placement, ShadeOnOneFacadeLeavesTheOther) {
    Effect shade{.name = "shade", .hook = Hook::aperture};
    const double all = cooling(shade, -0.5);
    shade.facade = 0;
    const double south = cooling(shade, -0.5);
    shade.facade = 1;
    const double west = cooling(shade, -0.5);
    EXPECT_LT(all, south);
    EXPECT_LT(south, 0);
    EXPECT_LT(west, 0);
    EXPECT_EQ(placed(shade).parameters[0].targets.size(), 1u);
}

TEST(Placement, BlindsOnAllFacadesFollowEachItsOwnSun) {
    const Effect blinds{.name = "blinds",
                        .hook = Hook::aperture,
                        .driver = Driver::bright,
                        .shape = {Form::over, 200}};
    const Placed all = placed(blinds);
    Effect south = blinds, west = blinds;
    south.facade = 0;
    west.facade = 1;
    const Placed each = place(std::vector{south, west}, office().around);
    EXPECT_EQ(shown(all, {-0.6}, Quantity::cooling),
              shown(each, {-0.6, -0.6}, Quantity::cooling));
}

TEST(Placement, GainsHeatAndMeterAdditionsDoNot) {
    const Effect people{
        .name = "people", .hook = Hook::gains, .driver = Driver::occupied};
    EXPECT_LT(heating(people, 5), -100);
    EXPECT_GT(cooling(people, 5), 100);
    Effect standing{.name = "standing", .hook = Hook::meter_addition};
    standing.meter = Quantity::gas;
    EXPECT_EQ(heating(standing, 2), 0);
    const double hours =
        static_cast<double>(office().drive.n_steps() - office().drive.n_warm_up);
    EXPECT_NEAR(raised(office(), standing, 2, Quantity::gas), 2 * 500 * hours / 1000,
                1e-6);
}

TEST(Placement, LightsAreMeteredAndHeat) {
    const Effect evening{.name = "evening",
                         .hook = Hook::lights_and_equipment,
                         .driver = Driver::hour,
                         .shape = {Form::within, 18, 22}};
    EXPECT_LT(heating(evening, 3), -50);
    const double days = 350;
    EXPECT_GE(raised(office(), evening, 3, Quantity::electricity),
              3 * 500 * 4 * days / 1000 - 1e-6);
}

TEST(Placement, SetPointsShift) {
    EXPECT_GT(heating({.name = "warmer", .hook = Hook::heating_set_point}, 1), 100);
    EXPECT_GT(cooling({.name = "cooler", .hook = Hook::cooling_set_point}, -1), 100);
    EXPECT_NEAR(heating({.name = "off", .hook = Hook::heating_available}, -1),
                -before_heating, 1e-9);
}

TEST(Placement, RoomsThatDifferMoreAskForMore) {
    const Effect rooms{.name = "rooms", .hook = Hook::room_spread};
    EXPECT_GT(heating(rooms, 2), 0);
    EXPECT_GT(heating(rooms, 4), heating(rooms, 2));
    EXPECT_GT(cooling(rooms, 4), 0);
}

TEST(Placement, ConversionFactors) {
    const Effect worse{.name = "worse", .hook = Hook::heating_efficiency};
    EXPECT_NEAR(raised(office(), worse, -0.1, Quantity::gas),
                before_heating / 0.9 * (1 / 0.9 - 1), 1e-6 * before_heating);
    Effect scale{.name = "scale", .hook = Hook::meter_factor};
    scale.meter = Quantity::electricity;
    const Placed unit = placed(scale);
    EXPECT_NEAR(raised(office(), scale, 0.1, Quantity::electricity),
                0.1 * total(shown(unit, {0}, Quantity::electricity)), 1e-6);
}

TEST(Placement, AHolidayIsASunday) {
    Effect holiday{.name = "holiday",
                   .hook = Hook::operation,
                   .driver = Driver::another_day,
                   .shape = {Form::linear, 6},
                   .gate = Gate::on_days};
    const auto day = [](const char* date) {
        return static_cast<int>(physics::parse_time(date).time_since_epoch().count() /
                                86400);
    };
    holiday.days = {{day("2021-05-04"), day("2021-05-06"), false}};
    const Placed closed = placed(holiday);
    Placed sunday{office().building, office().drive, {}};
    for (int step = sunday.drive.n_warm_up; step < sunday.drive.n_steps(); ++step) {
        const auto date = physics::format_date(sunday.drive.axis.begin_of(step));
        if (date >= "2021-05-04" && date <= "2021-05-06")
            sunday.drive.profiles(test::office_hours_row,
                                  static_cast<std::size_t>(step)) = 0;
    }
    for (const Quantity quantity : {Quantity::electricity, Quantity::gas})
        EXPECT_NEAR(total(shown(closed, {1}, quantity)),
                    total(shown(sunday, {}, quantity)), 1e-6);
}

// What an effect adds has a profile of its own, no schedule of the building's.
TEST(Placement, AHolidayLeavesGainsThatAnEffectAdded) {
    const Effect gains{.name = "people", .hook = Hook::gains, .driver = Driver::occupied};
    const Effect holiday{.name = "holiday",
                         .hook = Hook::operation,
                         .driver = Driver::another_day,
                         .shape = {Form::linear, 6}};
    const std::vector<Effect> all = {gains, holiday};
    const Placed both = place(all, office().around);
    const auto rows = [](const Placed& one) { return one.drive.profiles.rows; };
    EXPECT_EQ(rows(both) + office().drive.profiles.rows,
              rows(placed(gains)) + rows(placed(holiday)));
    EXPECT_NEAR(total(shown(both, {5, 0}, Quantity::gas)),
                total(shown(placed(gains), {5}, Quantity::gas)), 1e-9);
}

TEST(Placement, PlantThatRunsAtWeekendsHeatsThen) {
    Office heated;
    heated.building.zones[0].thermostat.heating_set_point.profile =
        test::office_hours_row;
    const Effect runs{.name = "runs",
                      .hook = Hook::plant_operation,
                      .driver = Driver::another_day,
                      .shape = {Form::linear, 0},
                      .gate = Gate::weekend};
    EXPECT_GT(raised(heated, runs, 1, Quantity::heating), 100);
    EXPECT_GT(raised(heated, runs, 1, Quantity::heating),
              raised(heated, runs, 0.5, Quantity::heating));
}

TEST(Placement, OccupationMovesLoadsOnly) {
    const Effect later{.name = "later",
                       .hook = Hook::occupation,
                       .driver = Driver::shifted_hours,
                       .shape = {Form::linear, 2}};
    const Placed moved = placed(later);
    EXPECT_EQ(moved.parameters[0].targets.size(), 4u);
    for (const physics::Target& target : moved.parameters[0].targets)
        EXPECT_EQ(target.part, physics::Part::load);
    const auto with = shown(moved, {1}, Quantity::electricity);
    const auto without = shown(moved, {0}, Quantity::electricity);
    EXPECT_NE(with, without);
}

TEST(Placement, ProfilesThatShapeRegimesHaveFewLevels) {
    const Effect windy{
        .name = "wind", .hook = Hook::infiltration, .driver = Driver::wind};
    const Placed with = placed(windy);
    const auto row = with.drive.profiles.row(with.drive.profiles.rows - 1);
    std::vector<double> values(row.begin(), row.end());
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    EXPECT_LE(values.size(), static_cast<std::size_t>(decisions::most_levels));
    const Effect sun{
        .name = "sun", .hook = Hook::opaque_boundary, .driver = Driver::sun_horizontal};
    const Placed exact = placed(sun);
    const auto sun_row = exact.drive.profiles.row(exact.drive.profiles.rows - 1);
    EXPECT_TRUE(std::equal(sun_row.begin(), sun_row.end(),
                           office().around.weather.at(Driver::sun_horizontal).begin()));
}

/// 24 levels of a uniform driver are off by 1 / (24 sqrt 12) of its range, rms: 1.2 %.
TEST(Placement, LevelsCostLittleOfWhatTheEffectBrings) {
    const Effect windy{
        .name = "wind", .hook = Hook::infiltration, .driver = Driver::wind};
    const Placed levels = placed(windy);
    Placed exact = levels;
    std::copy(office().around.weather.at(Driver::wind).begin(),
              office().around.weather.at(Driver::wind).end(),
              exact.drive.profiles.row(exact.drive.profiles.rows - 1).begin());
    const auto without = shown(levels, {0}, Quantity::heating);
    const auto few = shown(levels, {0.1}, Quantity::heating);
    const auto all = shown(exact, {0.1}, Quantity::heating);
    double error = 0, effect = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
        error += (few[k] - all[k]) * (few[k] - all[k]);
        effect += (all[k] - without[k]) * (all[k] - without[k]);
    }
    EXPECT_LT(std::sqrt(error / effect), 0.03);
    EXPECT_NEAR(total(few), total(all), 1e-3 * total(all));
}

TEST(Placement, TheSameProfileIsOneRow) {
    const Effect a{.name = "a", .hook = Hook::infiltration, .driver = Driver::one};
    Effect b{.name = "b", .hook = Hook::supply_air, .driver = Driver::one};
    const Placed both = place(std::vector{a, b}, office().around);
    EXPECT_EQ(both.drive.profiles.rows, office().drive.profiles.rows + 1);
    EXPECT_EQ(both.parameters.size(), 2u);
}

TEST(Placement, RangesAreTwoSidedAndEndWherePhysicsDoes) {
    Effect shade{.name = "shade", .hook = Hook::aperture};
    shade.least = -0.8;
    shade.most = 0;
    const physics::Parameter aperture = placed(shade).parameters[0];
    EXPECT_NEAR(aperture.least, -0.95, 1e-12);
    EXPECT_NEAR(aperture.most, 1.6, 1e-12);
    EXPECT_EQ(aperture.nominal, 0);
}

std::string why_not(const Effect& effect, const Surroundings& around) {
    return objection(effect, around).value_or("");
}

TEST(Objections, SayWhatIsMissing) {
    Office bare;
    bare.building.zones[0].thermostat.cooling_capacity.value = 0;
    bare.building.zones[0].flows.resize(1);
    const auto why = [&](const Effect& effect) { return why_not(effect, bare.around); };
    EXPECT_EQ(why({.hook = Hook::cooling_set_point}),
              "there is no cooling by a thermostat and a plant");
    EXPECT_EQ(why({.hook = Hook::ventilation}), "no air flow follows a schedule");
    EXPECT_EQ(why({.hook = Hook::meter_addition, .meter = Quantity::heating}),
              "it needs a meter of electricity, gas or district heat as its place");
    EXPECT_EQ(why({.hook = Hook::meter_factor}),
              "it needs a meter of energy as its place");
    EXPECT_EQ(why({.hook = Hook::aperture, .facade = 2}),
              "there is no window on this facade");
    EXPECT_EQ(why({.hook = Hook::neighbour, .gate = Gate::night}),
              "a conductance to another temperature is always there: it takes no gate");
    EXPECT_EQ(why({.hook = Hook::gains, .shape = {Form::under, 0}}),
              "it has no say at any step of this period");
    EXPECT_EQ(why({.hook = Hook::gains}), "");
    Effect column{.name = "tariff", .driver = Driver::column};
    column.column = "tariff";
    EXPECT_EQ(why(column),
              "'tariff' follows column (always), which this job does not have");
}

TEST(Objections, ASecondThresholdOfOpenings) {
    Effect low{.name = "low", .hook = Hook::venting}, high = low;
    low.shape.at = 22;
    high.shape.at = 25;
    EXPECT_THROW(place(std::vector{low, high}, office().around), CannotSimulate);
    EXPECT_NO_THROW(place(std::vector{low, low}, office().around));
}

}  // namespace
}  // namespace bemcal::effects
