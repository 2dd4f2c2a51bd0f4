/// Declared effects are what a search places: the same bits, in every period.
#include "base/error.hpp"
#include "effects/declared.hpp"
#include "effects/hooks.hpp"
#include "effects/loads.hpp"
#include "office.hpp"

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;
using test::Quantity;

/// One of each hook, and a second one at inputs that have one already.
std::vector<Effect> some_of_all() {
    std::vector<Effect> all;
    for (const HookRow& row : hook_rows()) {
        Effect effect{.name = row.name, .hook = row.hook, .least = -1, .most = 1};
        if (row.kind == physics::ChangeKind::schedule)
            effect.driver = Driver::another_day;
        if (effect.hook == Hook::neighbour) effect.driver = Driver::ground;
        if (row.is_at_a_meter) effect.meter = Quantity::gas;
        all.push_back(effect);
    }
    all.push_back({.name = "by wind",
                   .hook = Hook::infiltration,
                   .driver = Driver::wind,
                   .gate = Gate::night,
                   .least = -1,
                   .most = 1});
    all.push_back(
        {.name = "by the sun", .hook = Hook::aperture, .driver = Driver::bright});
    return all;
}

DeclaredEffects declared_in(const Office& office, std::vector<Effect> effects,
                            double coefficient) {
    DeclaredEffects declared;
    declared.coefficients.assign(effects.size(), coefficient);
    declared.effects = std::move(effects);
    declared.building = office.building;
    declared.first_row = office.drive.profiles.rows;
    declared.from = office.around.from;
    return declared;
}

/// With rows that are empty, as a case keeps them.
physics::Drive with_rows(const physics::Drive& drive, std::size_t n) {
    physics::Drive wider = drive;
    wider.profiles.rows += n;
    wider.profiles.values.resize(wider.profiles.rows * wider.profiles.cols);
    return wider;
}

std::vector<std::vector<double>> shown_by(const DeclaredEffects& declared,
                                          const Office& period) {
    DeclaredEffects own = declared;
    Placed placed;
    placed.building = building_with(own, period.drive, period.weather, own.n_rows);
    placed.drive = with_rows(period.drive, own.n_rows);
    write_profiles(own, placed.building, period.weather, placed.drive);
    return test::all_shown(placed, {});
}

TEST(Declared, EffectsBringWhatPlacedOnesDoInEveryPeriod) {
    const Office training, later("2021-06-01", "2021-09-01");
    for (const Effect& effect : some_of_all()) {
        const DeclaredEffects declared = declared_in(training, {effect}, 0.05);
        for (const Office* period : {&training, &later}) {
            Surroundings around = period->around;
            around.from = declared.from;
            const Placed placed = place(std::span(&effect, 1), around);
            EXPECT_EQ(shown_by(declared, *period), test::all_shown(placed, {0.05}))
                << effect.name;
        }
    }
}

TEST(Declared, EffectsStandBesideEachOther) {
    const Office office;
    std::vector<Effect> three(3);
    for (std::size_t k = 0; k < three.size(); ++k) {
        three[k].name = std::to_string(k);
        three[k].hook = Hook::infiltration;
        three[k].driver = Driver::wind;
        three[k].most = 1;
    }
    three[2].hook = Hook::gains;
    const Placed placed = place(three, office.around);
    EXPECT_EQ(shown_by(declared_in(office, three, 0.02), office),
              test::all_shown(placed, {0.02, 0.02, 0.02}));
}

TEST(Declared, CoefficientsAreNumbersWithAPathAndARange) {
    const Office office;
    Effect effect{.name = "wind infiltration",
                  .hook = Hook::infiltration,
                  .driver = Driver::wind,
                  .most = 0.15};
    DeclaredEffects declared = declared_in(office, {effect}, 0.03);
    const physics::Building building =
        building_with(declared, office.drive, office.weather, declared.n_rows);
    const auto targets = physics::resolve(building, "effect.wind infiltration");
    ASSERT_EQ(targets.size(), 1U);
    EXPECT_EQ(physics::number_at(building, targets[0]), 0.03);
    const physics::NumberInfo info = physics::info_of(building, targets[0]);
    EXPECT_STREQ(info.unit, "1/h per m/s");
    EXPECT_EQ(info.most, 0.3);
    // Another number of the same input keeps its own.
    const auto own =
        physics::resolve(building, "zone.office.flow.infiltration.air_change");
    EXPECT_STREQ(physics::info_of(building, own[0]).name, "air_change");
    EXPECT_EQ(physics::coefficient_at(building, own[0]), nullptr);
}

TEST(Declared, EffectsNeedWhatTheyFollowInEveryPeriod) {
    const Office office;
    Effect effect{.name = "with the rain",
                  .hook = Hook::gains,
                  .driver = Driver::column,
                  .column = "rain",
                  .most = 1};
    DeclaredEffects declared = declared_in(office, {effect}, 0.1);
    EXPECT_THROW(building_with(declared, office.drive, office.weather, declared.n_rows),
                 CannotSimulate);
    declared.effects[0].driver = Driver::wind;
    declared.n_rows = 2;  // of a period with another input
    physics::Drive drive = with_rows(office.drive, 2);
    EXPECT_THROW(write_profiles(declared, office.building, office.weather, drive),
                 CannotSimulate);
}

// The boiler's part load is that of the building with its other effects; 1 is full_load.
TEST(Declared, LoadsAreThoseOfTheBuildingWithItsOtherEffects) {
    const Office office;
    const Effect part_load{.name = "part load",
                           .hook = Hook::heating_efficiency,
                           .driver = Driver::heating_load,
                           .shape = {Form::below, 0.3},
                           .least = -1,
                           .most = 1,
                           .is_smooth = true,
                           .full_load = 20'000};
    const Effect warmth{.name = "warmth", .hook = Hook::gains, .least = -9, .most = 9};
    DeclaredEffects declared = declared_in(office, {part_load, warmth}, -0.5);
    declared.coefficients[1] = 4;
    EXPECT_TRUE(declared.follow_loads());
    const physics::Building building =
        building_with(declared, office.drive, office.weather, declared.n_rows);
    physics::Drive drive = with_rows(office.drive, declared.n_rows);
    write_profiles(declared, building, office.weather, drive);

    DeclaredEffects other = declared_in(office, {warmth}, 4);
    const physics::Building warmed =
        building_with(other, office.drive, office.weather, other.n_rows);
    physics::Drive of_warmed = with_rows(office.drive, other.n_rows);
    write_profiles(other, warmed, office.weather, of_warmed);
    const ModelSeries loads = loads_of(warmed, of_warmed);
    const auto row = drive.profiles.row(declared.first_row);
    double most = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
        EXPECT_NEAR(row[k], std::max(0.0, 0.3 - loads.heating[k] / 20'000), 1e-12);
        most = std::max(most, loads.heating[k]);
    }
    EXPECT_GT(most, 6'000);
    EXPECT_LT(most, loads_of(office.building, office.drive).most_heating);
}

}  // namespace
}  // namespace bemcal::effects
