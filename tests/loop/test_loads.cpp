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
    EXPECT_FALSE(follow_loads(windy.standing.model, {}));
}

}  // namespace
}  // namespace bemcal::loop
