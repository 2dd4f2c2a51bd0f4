/// Buildings whose plant runs at other hours than declared, or just at these.
#include "effects/catalogue.hpp"
#include "loop/effect_values.hpp"
#include "loop/hour_search.hpp"
#include "loop/intervals.hpp"
#include "loop/loop.hpp"
#include "loop/other_hours.hpp"
#include "loop/windy_case.hpp"
#include "study/find.hpp"

#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using physics::WeekHours;
using test::find;

namespace {

constexpr WeekHours declared = {{{6, 18}, {}, {}}}, later = {{{9, 21}, {8, 13}, {}}};

LoopOptions quick() {
    LoopOptions options;
    options.block_days = 7;
    options.try_structures = false;
    options.generic = false;
    options.functions = false;
    return options;
}

/// A plant that is much larger than needed: less of it does nothing, only hours matter.
study::Case building_with(const WeekHours& truth, std::uint64_t seed) {
    study::Case made = test::windy_case();
    physics::Thermostat& thermostat = made.building.zones[0].thermostat;
    thermostat.heating_set_point = {21, 0, -1};
    thermostat.heating_capacity = {2000, 0, -1};
    thermostat.heating_available = {1, 0, 1};
    physics::Profile plant = made.profiles[0];
    plant.name = "plant";
    physics::set_hours(truth, plant.schedule);
    made.profiles.push_back(plant);
    test::measure(made, test::named("wind infiltration"), 0, seed);
    physics::set_hours(declared, made.profiles[1].schedule);
    return made;
}

std::vector<study::Dataset> searched(const study::Case& made,
                                     const LoopOptions& options = quick()) {
    const std::vector<study::Case> buildings = {made};
    const auto stage = make_loop("loop", buildings, options);
    return stage->conclude({stage->run(0)}).datasets;
}

double error_of(const std::vector<study::Dataset>& datasets, std::size_t model,
                std::size_t period) {
    return find(datasets, "fit").values[(model * 2 + period) * 2 * 4 + 1];
}

}  // namespace

TEST(OtherHours, OfALargePlantAreFoundExactly) {
    const auto datasets = searched(building_with(later, 3));
    const auto& names = find(datasets, "effect").texts;
    ASSERT_EQ(names.size(), 1U);
    EXPECT_EQ(names[0], "other hours than declared");
    EXPECT_EQ(find(datasets, "effect_shape").texts[0],
              "plant runs Monday to Friday 9 to 21 h, Saturdays 8 to 13 h; declared 6 to "
              "18 h, off");
    EXPECT_EQ(find(datasets, "effect_coefficient").values[0], 1);
    EXPECT_EQ(find(datasets, "effect_least").values[0], 1);
    EXPECT_EQ(find(datasets, "effect_doubt").texts[0], "");
    // They count after, and hold in what was not seen.
    for (const std::size_t period : {0, 1})
        EXPECT_LT(error_of(datasets, 2, period), 0.5 * error_of(datasets, 1, period));
}

TEST(OtherHours, AreNotSoughtWhereTheJobExcludesThem) {
    LoopOptions options = quick();
    options.exclude = {"other hours than declared"};
    const auto datasets = searched(building_with(later, 3), options);
    for (const std::string& name : find(datasets, "effect").texts)
        EXPECT_NE(name, "other hours than declared");
}

// Of two schedules that changed alike the first tells what both bring, the other nothing.
TEST(OtherHours, OfSchedulesThatChangedAlikeAreWorthOneThing) {
    study::Case made = building_with(later, 3);
    made.building.zones[0].thermostat.cooling_available = {1, 0, 2};
    made.profiles.push_back(made.profiles[1]);
    made.profiles[2].name = "cold";
    const LoopData data(made, quick());
    const Place place = make_place(data, {}, data.drive);
    const auto effect = [&](std::size_t profile, const WeekHours& hours) {
        const ScheduleHours schedule(data, profile);
        return effects::with_hours(
            {made.profiles[profile].name, static_cast<int>(profile),
             static_cast<int>(schedule.numbered_row()), 0, 1, hours, declared});
    };
    const auto worth_of = [&](std::vector<effects::Effect> all) {
        LoopModel with;
        with.effects = std::move(all);
        const std::vector<double> x(place.unknowns.size() + with.effects.size());
        const Standing standing = calibrate(data, place, with, x);
        return worth_of_effects(data, place, standing, deviations_of(data, standing, 1),
                                1, accounts_of(data));
    };
    const Worth alone = worth_of({effect(1, later)})[0][0];
    const auto both = worth_of({effect(1, later), effect(2, later)});
    EXPECT_NEAR(both[0][0].mean, alone.mean, 1e-6 * std::abs(alone.mean));
    EXPECT_TRUE(std::isnan(both[1][0].mean));
    // At other hours each is a thing of its own.
    EXPECT_FALSE(std::isnan(
        worth_of({effect(1, later), effect(2, {{{9, 22}, {8, 13}, {}}})})[1][0].mean));
    // Hours have no coefficient: the model's error is that of what they bring.
    EXPECT_GE(alone.most - alone.mean, 1.64 * 0.08 * std::abs(alone.mean));
}

// Odd hours and even ones: what is simulated between the best of every second hour finds
// what all runs do, with a third of them.
TEST(HourSearch, BestOfEverySecondHourIsTheBestOfAll) {
    for (const physics::DailyRun right :
         {physics::DailyRun{9, 21}, {8, 20}, {7, 16}, {6, 18}, {0, 24}, {}}) {
        const LoopData data(building_with({right}, 3), quick());
        const Place place = make_place(data, {}, data.drive);
        const Standing plain = calibrate_plain(data);
        std::vector<WeekHours> found;
        std::vector<std::size_t> n_tried;
        for (const Tries tries : {Tries::all, Tries::near_the_best}) {
            HourSearch search(
                data, place, plain, {{ScheduleHours(data, 1), declared, declared}},
                [](const auto&, const auto&) { return 0; }, tries);
            n_tried.push_back(
                search.improve(0, physics::DayKind::working_day, false).size());
            found.push_back(search.hours(0));
        }
        EXPECT_EQ(found[0], found[1]) << right.from << " " << right.until;
        EXPECT_LT(n_tried[1], 0.4 * static_cast<double>(n_tried[0]));
    }
}

// 20 buildings, none named: fewer than one in seven, with a probability of 95 %.
TEST(OtherHours, DeclaredOnesThatAreRightStay) {
    int n_named = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const LoopData data(building_with(declared, seed), quick());
        const Place place = make_place(data, {}, data.drive);
        for (const Departure& found : other_hours(data, place, calibrate_plain(data)))
            n_named += found.effect.other_hours->hours == declared ? 0 : 1;
    }
    EXPECT_EQ(n_named, 0);
}

// What a loop knows of days that are closed is then said of the new hours, too.
TEST(OtherHours, AreTheScheduleForAllOtherEffects) {
    const LoopData data(building_with(later, 3), quick());
    const Place place = make_place(data, {}, data.drive);
    const auto found = other_hours(data, place, calibrate_plain(data));
    ASSERT_EQ(found.size(), 1U);
    const BuiltModel built = build(place, {found[0].effect});
    const auto own = built.placed->drive.profiles.row(1);
    const LoopData right(
        [] {
            study::Case made = building_with(later, 3);
            physics::set_hours(later, made.profiles[1].schedule);
            return made;
        }(),
        quick());
    const auto true_row = right.drive->profiles.row(1);
    EXPECT_TRUE(std::ranges::equal(own, true_row));
}
