/// Loads that a last model follows are its own, in every period.
#include "effects/loads.hpp"
#include "loop/loads.hpp"
#include "loop/period_hours.hpp"
#include "loop/windy_model.hpp"

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

constexpr const char* part_load = "part-load efficiency of heating";

/// Wind and the boiler's part load in a model that was calibrated with the loads of the
/// one before.
struct Windy {
    Windy() : data(test::WindyModel::measured(), test::WindyModel::options()) {
        place = make_place(data, {}, data.drive);
        const Standing plain =
            calibrate(data, place, {}, std::vector<double>(place.unknowns.size()));
        know_loads(place, plain, {});
        const LoopModel model{{},
                              {test::named("wind infiltration"), test::named(part_load)}};
        last =
            calibrate(data, place, model, std::vector<double>(place.unknowns.size() + 2));
    }
    LoopData data;
    Place place;
    Standing last;
};

TEST(Loads, SettledAreThoseOfTheModelItself) {
    Windy windy;
    const effects::ModelSeries searched = windy.place.surroundings->model;
    settle_loads(windy.data, {}, windy.place, windy.last);
    const effects::ModelSeries& settled = windy.place.surroundings->model;
    EXPECT_NE(settled.heating, searched.heating);
    EXPECT_EQ(windy.last.model.effects[1].full_load, searched.most_heating);
    EXPECT_EQ(windy.last.model.effects[0].full_load, 0);

    const Place anew = place_in(windy.data, windy.last, {}, windy.data.drive);
    EXPECT_EQ(anew.surroundings->model.heating, settled.heating);
    EXPECT_EQ(hours_of(windy.data, windy.last, {}, windy.data.drive)[0],
              windy.last.fit.at.predicted);
}

TEST(Loads, AModelThatFollowsNoneStaysAsItIs) {
    test::WindyModel windy({"wind infiltration"});
    const std::vector<double> x = windy.standing.fit.at.x;
    settle_loads(windy.data, {}, windy.place, windy.standing);
    EXPECT_EQ(windy.standing.fit.at.x, x);
    EXPECT_TRUE(windy.place.surroundings->model.heating.empty());
    EXPECT_FALSE(follow_loads(windy.data, windy.standing.model, {}));
}

/// A building with the boiler's part load by its description, and gas that wind raises.
study::Case declared() {
    study::Case made = test::windy_case();
    effects::DeclaredEffects own;
    own.effects = {test::named(part_load)};
    own.effects[0].full_load = 9'000;
    own.coefficients = {-0.9};
    own.building = made.building;
    own.first_row = made.profiles.size();
    own.from = made.periods[0].from;
    const physics::Drive drive = study::drive_of(made, made.periods[0]);
    made.building = effects::building_with(own, drive, made.weather, own.n_rows);
    made.profiles.insert(made.profiles.end(), own.n_rows,
                         effects::empty_row(made.weather));
    made.declared_effects = std::make_shared<effects::DeclaredEffects>(std::move(own));
    test::measure(made, test::named("wind infiltration"), 0.08, 3);
    return made;
}

// As in a job that has the parameters' values.
TEST(Loads, ThatDeclaredEffectsFollowAreThoseOfTheLastModel) {
    const study::Case made = declared();
    const LoopData data(made, test::WindyModel::options());
    Place place = make_place(data, {}, data.drive);
    Standing last =
        calibrate(data, place, {}, std::vector<double>(place.unknowns.size()));
    EXPECT_TRUE(follow_loads(data, last.model, {}));
    settle_loads(data, {}, place, last);

    study::Case adopted = made;
    physics::apply(made.building, made.parameters, values_in(last.built, last),
                   adopted.building);
    const physics::Drive drive = study::drive_of(adopted, adopted.periods[0]);
    const auto expected = physics::predict(adopted.building, drive,
                                           physics::simulate(adopted.building, drive),
                                           physics::Quantity::gas);
    const auto found = hours_of(data, last, {}, data.drive)[0];
    const physics::Drive as_described = study::drive_of(made, made.periods[0]);
    const std::size_t row = made.declared_effects->first_row;
    double moved = 0;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k], expected[k], 1e-9 * (1 + expected[k]));
        EXPECT_NEAR(last.fit.at.predicted[k], expected[k], 1e-9 * (1 + expected[k]));
        const std::size_t step = k + static_cast<std::size_t>(drive.n_warm_up);
        moved = std::max(moved, std::abs(drive.profiles(row, step) -
                                         as_described.profiles(row, step)));
    }
    EXPECT_GT(moved, 0.02);
}

}  // namespace
}  // namespace bemcal::loop
