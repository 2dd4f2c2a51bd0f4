/// Buildings made with hours that their description does not have.
#include "loop/learn_hours.hpp"
#include "loop/loop.hpp"
#include "loop/windy_case.hpp"
#include "study/find.hpp"

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using physics::DailyRun;
using physics::WeekHours;
using test::find;

namespace {

constexpr WeekHours late = {{{9, 21}, {8, 13}, {}}};

LoopOptions hours_only() {
    LoopOptions options;
    options.block_days = 7;
    options.try_structures = false;
    options.most_effects = 0;
    options.functions = false;
    return options;
}

/// The windy building whose readings follow these hours, which nobody wrote down.
study::Case building_with(const WeekHours& truth, const char* use, std::uint64_t seed) {
    study::Case made = test::windy_case();
    physics::set_hours(truth, made.profiles[0].schedule);
    test::measure(made, test::named("wind infiltration"), 0, seed);
    const WeekHours usual = *physics::usual_hours(use);
    physics::set_hours(usual, made.profiles[0].schedule);
    made.unknown_hours = {{0, use, usual}};
    return made;
}

std::vector<LearnedHours> learned_in(const study::Case& made) {
    const LoopData data(made, hours_only());
    return learn_hours(data, calibrate_plain(data), usual_hours_of(made));
}

std::vector<study::Dataset> searched(const study::Case& made) {
    const std::vector<study::Case> buildings = {made};
    const auto stage = make_loop("loop", buildings, hours_only());
    return stage->conclude({stage->run(0)}).datasets;
}

}  // namespace

TEST(LearnHours, FindsTheHoursThatReadingsFollow) {
    for (const char* use : {"office", "home", "shop"}) {
        const auto learned = learned_in(building_with(late, use, 3));
        ASSERT_EQ(learned.size(), 1U);
        EXPECT_EQ(learned[0].hours(), late) << use << " " << sentence_of(learned[0]);
        EXPECT_GT(learned[0].evidence, 1000);
        for (const LearnedRun& run : learned[0].runs) EXPECT_GT(run.probability, 0.9);
        EXPECT_EQ(learned[0].runs[0].least, late[0]);
        EXPECT_EQ(learned[0].runs[0].most, late[0]);
    }
}

TEST(LearnHours, FindsThatAPlantIsNeverOffOrNeverOn) {
    const WeekHours never_off = {{{0, 24}, {0, 24}, {}}};
    EXPECT_EQ(learned_in(building_with(never_off, "office", 5))[0].hours(), never_off);
}

TEST(LearnHours, StaysAtUsualHoursThatAreRight) {
    const WeekHours usual = *physics::usual_hours("office");
    int n_other = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto learned = learned_in(building_with(usual, "office", seed));
        n_other += learned[0].hours() == usual ? 0 : 1;
    }
    EXPECT_EQ(n_other, 0);  // of 10
}

// A plant that is much larger than the building needs: less of it changes nothing, and
// only hours show. Two schedules that begin at the same usual hours are told apart.
TEST(LearnHours, FindsHoursOfAnOversizedPlantBesideThoseOfUse) {
    study::Case made = test::windy_case();
    physics::Zone& zone = made.building.zones[0];
    zone.thermostat.heating_set_point = {21, 0, -1};
    zone.thermostat.heating_capacity = {2000, 0, -1};
    zone.thermostat.heating_available = {1, 0, 1};
    physics::Profile plant = made.profiles[0];
    plant.name = "plant";
    made.profiles.push_back(plant);
    const WeekHours of_use = {{{10, 17}, {}, {}}}, of_plant = {{{5, 21}, {7, 12}, {}}};
    physics::set_hours(of_use, made.profiles[0].schedule);
    physics::set_hours(of_plant, made.profiles[1].schedule);
    test::measure(made, test::named("wind infiltration"), 0, 3);
    const WeekHours usual = *physics::usual_hours("office");
    for (const std::size_t profile : {0, 1}) {
        physics::set_hours(usual, made.profiles[profile].schedule);
        made.unknown_hours.push_back({profile, "office", usual});
    }
    const auto learned = learned_in(made);
    EXPECT_EQ(learned[0].hours(), of_use) << sentence_of(learned[0]);
    EXPECT_EQ(learned[1].hours(), of_plant) << sentence_of(learned[1]);
}

TEST(LearnHours, AreWrittenIntoTheBuilding) {
    const study::Case made = building_with(late, "office", 3);
    const auto learned = learned_in(made);
    EXPECT_EQ(physics::hours_of(with_hours(made, learned).profiles[0].schedule), late);
    EXPECT_EQ(physics::hours_of(made.profiles[0].schedule),
              physics::usual_hours("office"));
}

TEST(LearnHours, AreSaidWithWhatIsNotCertain) {
    LearnedHours learned{0, "work", "office", {}, {}, 0};
    learned.runs = {{{{8, 19}, 0.99, {}, {}}, {{}, 0.6, {}, {}}, {{}, 0.95, {}, {}}}};
    EXPECT_EQ(sentence_of(learned),
              "schedule work: Monday to Friday 8 to 19 h, Saturdays off, Sundays and "
              "holidays off; learned, nobody declared it; not certain: Saturdays "
              "(probability 0.60)");
}

TEST(LearnHours, AreUncertainBelowNineOfTen) {
    LearnedHours learned{0, "work", "office", {}, {}, 0};
    const auto is_certain = [&](double probability) {
        for (LearnedRun& run : learned.runs) run.probability = probability;
        return sentence_of(learned).find("not certain") == std::string::npos;
    };
    EXPECT_TRUE(is_certain(0.9));
    EXPECT_FALSE(is_certain(0.899));
}

// Plain is the job as it is written: it has the usual hours, in every period.
TEST(LearnHours, CountBefore) {
    const auto datasets = searched(building_with(late, "office", 3));
    const auto& fit = find(datasets, "fit");
    const auto error = [&](std::size_t model, std::size_t period) {
        return fit.values[(model * 2 + period) * 2 * 4 + 1];
    };
    for (const std::size_t period : {0, 1}) {
        EXPECT_GT(error(0, period), 2 * error(1, period));
        EXPECT_EQ(error(1, period), error(2, period));
    }
    EXPECT_EQ(find(datasets, "learned_schedule").texts,
              std::vector<std::string>{"office_hours"});
    EXPECT_EQ(find(datasets, "learned_hours_from").values,
              (std::vector<double>{9, 8, 0}));
    EXPECT_EQ(find(datasets, "learned_hours_until").values,
              (std::vector<double>{21, 13, 0}));
    EXPECT_EQ(find(datasets, "learned_hours_usual_until").values,
              (std::vector<double>{18, 0, 0}));
}

TEST(LearnHours, NoneAreStoredWhereAllAreGiven) {
    study::Case made = building_with(late, "office", 3);
    made.unknown_hours.clear();
    EXPECT_TRUE(find(searched(made), "learned_schedule").texts.empty());
}
