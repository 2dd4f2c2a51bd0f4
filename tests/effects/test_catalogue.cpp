#include "effects/catalogue.hpp"
#include "effects/grammar.hpp"
#include "effects/hooks.hpp"
#include "office.hpp"

#include <set>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;
using test::Quantity;

const Office& office() {
    static const Office one;
    return one;
}

constexpr physics::Quantity meters[] = {physics::Quantity::air_temperature,
                                        physics::Quantity::electricity,
                                        physics::Quantity::gas};

const std::vector<Effect>& named() {
    static const std::vector<Effect> all = named_candidates(office().around, meters);
    return all;
}

const std::vector<Effect>& generic() {
    static const std::vector<Effect> all = generic_candidates(office().around, meters);
    return all;
}

TEST(Catalogue, HasEveryNumberAndNoNameTwice) {
    std::set<int> numbers;
    std::set<std::string> names;
    for (const Entry& entry : catalogue()) {
        numbers.insert(entry.effect.number);
        EXPECT_TRUE(names.insert(entry.effect.name).second) << entry.effect.name;
    }
    EXPECT_GE(numbers.size(), 45u);
    EXPECT_EQ(*numbers.begin(), 1);
    EXPECT_EQ(*numbers.rbegin(), static_cast<int>(numbers.size()));
}

TEST(Catalogue, StandsByNumber) {
    EXPECT_TRUE(std::ranges::is_sorted(
        catalogue(), {}, [](const Entry& entry) { return entry.effect.number; }));
}

TEST(Catalogue, EveryRowSaysAllOfItsTexts) {
    for (const Entry& entry : catalogue())
        for (const char* text :
             {entry.sentence, entry.signature, entry.like, entry.separates})
            EXPECT_NE(std::string(text), "") << entry.effect.name;
}

TEST(Catalogue, TypicalCoefficientsArePlausible) {
    for (const Entry& entry : catalogue()) {
        EXPECT_LE(entry.effect.least, entry.effect.typical) << entry.effect.name;
        EXPECT_LE(entry.effect.typical, entry.effect.most) << entry.effect.name;
        EXPECT_NE(entry.effect.typical, 0) << entry.effect.name;
    }
}

TEST(Catalogue, ThermalBridgesAreTheTransmissionItself) {
    for (const Entry& entry : catalogue())
        EXPECT_EQ(same_as(entry.effect),
                  std::string(entry.effect.name) == "thermal bridges" ? "H_op" : "");
    EXPECT_EQ(same_as(generic()[0]), "");
}

TEST(Catalogue, EveryRowIsFoundByItsEffect) {
    for (const Entry& entry : catalogue())
        EXPECT_EQ(entry_of(entry.effect), &entry) << entry.effect.name;
    EXPECT_EQ(entry_of(Effect{.name = "gains: wind"}), nullptr);
}

TEST(Catalogue, EveryRowCanEnterAnOfficeWithEverything) {
    std::set<std::string> entered;
    for (const Effect& effect : named()) entered.insert(effect.name);
    const int day = static_cast<int>(
        physics::parse_time("2021-05-04").time_since_epoch().count() / 86400);
    for (const Entry& entry : catalogue()) {
        if (entry.each == Each::data || entry.each == Each::found_hours) continue;
        if (entry.each == Each::found_days) {
            const Effect found = with_days(entry.effect.name, {{day, day + 2}});
            EXPECT_EQ(objection(found, office().around), std::nullopt);
            continue;
        }
        if (entry.each == Each::cooling_meter) continue;  // below
        EXPECT_EQ(entered.count(entry.effect.name), 1u) << entry.effect.name;
    }
}

/// At its typical size every effect that a row names moves a meter, or the temperature,
/// by a ten-thousandth of its sum at least.
TEST(Catalogue, TypicalEffectsAreSeen) {
    const auto before =
        test::all_shown(Placed{office().building, office().drive, {}}, {});
    std::set<std::string> seen;
    for (const Effect& effect : named()) {
        if (!seen.insert(effect.name).second) continue;
        const Placed placed = place(std::span(&effect, 1), office().around);
        const auto after = test::all_shown(placed, {effect.typical});
        double largest = 0;
        for (const std::size_t meter : {0, 3, 4}) {
            double moved = 0, size = 0;
            for (std::size_t k = 0; k < after[meter].size(); ++k) {
                moved += std::abs(after[meter][k] - before[meter][k]);
                size += std::abs(before[meter][k]);
            }
            largest = std::max(largest, moved / size);
        }
        EXPECT_GT(largest, 1e-4) << effect.name;
    }
}

TEST(Candidates, ExpandShapesFacadesAndMeters) {
    const auto count = [](const char* name, std::optional<int> facade,
                          std::optional<Quantity> meter) {
        return std::ranges::count_if(named(), [&](const Effect& effect) {
            return effect.name == name && effect.facade == facade &&
                   effect.meter == meter;
        });
    };
    EXPECT_EQ(count("blinds", {}, {}), 5);
    EXPECT_EQ(count("blinds", 0, {}), 5);
    EXPECT_EQ(count("blinds", 1, {}), 5);
    EXPECT_EQ(count("blinds", 2, {}), 0);
    EXPECT_EQ(count("standing losses", {}, Quantity::gas), 1);
    EXPECT_EQ(count("standing losses", {}, Quantity::electricity), 1);
    EXPECT_EQ(count("standing losses", {}, Quantity::air_temperature), 0);
    EXPECT_EQ(count("a free weekday", {}, {}), 5);
    EXPECT_EQ(count("summer time not applied", {}, {}), 4);
    EXPECT_EQ(count("retrofit of walls", {}, {}), 11);
}

TEST(Candidates, AMeterOfCoolingSeesLatentLoad) {
    constexpr Quantity of_cooling[] = {Quantity::cooling};
    const auto with = named_candidates(office().around, of_cooling);
    EXPECT_EQ(std::count_if(with.begin(), with.end(),
                            [](const Effect& effect) {
                                return effect.name ==
                                       "latent load on the meter of cooling";
                            }),
              5);
}

TEST(Candidates, AreAsManyAsASearchCanTake) {
    EXPECT_GT(named().size(), 150u);
    EXPECT_LT(named().size(), 450u);
    EXPECT_GT(generic().size(), 300u);
    EXPECT_LT(generic().size(), 650u);
}

TEST(Candidates, TheGrammarNamesNothingOfTheCatalogueAndNothingTwice) {
    std::set<std::string> names;
    for (const Effect& effect : generic()) {
        EXPECT_EQ(entry_of(effect), nullptr);
        EXPECT_TRUE(names.insert(effect.name).second) << effect.name;
        EXPECT_EQ(effect.least, -effect.most);
        EXPECT_GT(effect.typical, 0);
        EXPECT_FALSE(effect.hook == Hook::infiltration && effect.driver == Driver::wind);
    }
}

TEST(Candidates, TypicalEffectsOfTheGrammarCanBeSimulated) {
    for (std::size_t k = 0; k < generic().size(); k += 9) {
        const Effect& effect = generic()[k];
        const Placed placed = place(std::span(&effect, 1), office().around);
        EXPECT_NO_THROW(test::all_shown(placed, {effect.typical})) << effect.name;
    }
}

TEST(Candidates, AHouseWithoutCoolingHasFewer) {
    Office house;
    house.building.zones[0].thermostat.cooling_capacity.value = 0;
    for (const Effect& effect : named_candidates(house.around, meters)) {
        EXPECT_NE(effect.hook, Hook::cooling_set_point);
        EXPECT_NE(effect.hook, Hook::cooling_cop);
    }
}

TEST(Catalogue, HolidaysAreSundaysOnTheDaysFound) {
    const Effect holidays = closed_days({{18751, 18753}});
    EXPECT_EQ(holidays.number, 22);
    EXPECT_EQ(holidays.gate, Gate::on_days);
    EXPECT_EQ(sentence_of(holidays), "as on Sunday, 2021-05-04 to 2021-05-06");
    EXPECT_THROW(with_days("wind infiltration", {}), std::invalid_argument);
}

TEST(Catalogue, HolidaysOfACalendarAreNamedByIt) {
    Effect holidays = closed_days({{18751, 18751, false, true}, {18760, 18761, true}});
    holidays.calendar = "US";
    EXPECT_EQ(
        sentence_of(holidays),
        "as on Sunday, on the public holidays of US, 05-13 to 05-14 (month-day, every "
        "year)");
}

TEST(Catalogue, SummerTimeShiftsSchedulesBetweenItsDays) {
    const auto found = std::find_if(
        named().begin(), named().end(),
        [](const Effect& effect) { return effect.name == "summer time not applied"; });
    ASSERT_NE(found, named().end());
    EXPECT_EQ(sentence_of(*found), "1 h earlier, in EU summer time");
    const Placed placed = place(std::span(&*found, 1), office().around);
    const auto row = placed.drive.profiles.row(office().drive.profiles.rows);
    const auto at = [&](const char* time) {
        return row[static_cast<std::size_t>(
            office().drive.axis.step_of(physics::parse_time(time)))];
    };
    EXPECT_EQ(at("2021-03-26 07:00"), 0);
    EXPECT_EQ(at("2021-03-29 07:00"), 1);
    EXPECT_EQ(at("2021-03-29 17:00"), -1);
    EXPECT_EQ(at("2021-10-29 07:00"), 1);
    EXPECT_EQ(at("2021-11-01 07:00"), 0);
}

TEST(Catalogue, DescribeNamesEveryRowAndHook) {
    const std::string text = describe();
    for (const Entry& entry : catalogue())
        EXPECT_NE(text.find(entry.effect.name), std::string::npos);
    for (const HookRow& row : hook_rows())
        EXPECT_NE(text.find(row.name), std::string::npos);
    for (const GroupRow& row : group_rows)
        EXPECT_NE(text.find(row.words), std::string::npos);
    EXPECT_NE(text.find("H_op (exact)"), std::string::npos);
}

}  // namespace
}  // namespace bemcal::effects
