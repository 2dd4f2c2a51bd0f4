/// Effects of the place: the parabola, and a building whose air is warmer than the
/// weather.
#include "loop/of_the_place.hpp"
#include "loop/windy_model.hpp"

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

TEST(LowestPoint, IsThatOfTheParabola) {
    const auto deviance = [](double b) { return 7 + std::pow((b - 0.4) / 0.1, 2); };
    for (const double step : {1.0, -0.5}) {
        const auto found =
            lowest_point(deviance(-step), deviance(0), deviance(step), step);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->first, 0.4, 1e-12);
        EXPECT_NEAR(found->second, 0.1, 1e-12);
    }
}

TEST(LowestPoint, IsNoneOfALineAndNoneBeyondThreeSteps) {
    EXPECT_FALSE(lowest_point(2, 1, 0, 1));
    EXPECT_FALSE(lowest_point(0, 1, 0, 1));
    EXPECT_FALSE(lowest_point(nan, 1, 3, 1));
    const auto at = [](double where) {
        const auto deviance = [&](double b) { return std::pow(b - where, 2); };
        return lowest_point(deviance(-1), deviance(0), deviance(1), 1);
    };
    EXPECT_TRUE(at(2.99));
    EXPECT_FALSE(at(3.01));
}

study::PlaceEffect station_in(const study::Case& made) {
    const LoopData data(made, test::WindyModel::options());
    const Place place = make_place(data, {}, data.drive);
    const Standing standing =
        calibrate(data, place, {}, std::vector<double>(place.unknowns.size()));
    const PowerTable power = power_of(data, place, standing);
    for (const study::PlaceEffect& effect :
         effects_of_the_place(data, place, standing, power))
        if (effect.name == "urban heat island or station offset") return effect;
    return {};
}

// Parameters may take it: how far is in the standard deviation.
TEST(EffectsOfThePlace, AreWhatTheReadingsSayOfEach) {
    for (const double offset : {0.0, 2.0}) {
        study::Case made = test::windy_case();
        test::measure(made, test::named("urban heat island or station offset"), offset,
                      3);
        const study::PlaceEffect station = station_in(made);
        EXPECT_EQ(station.unit, "K");
        EXPECT_EQ(station.typical, 1);
        EXPECT_GT(station.sd, 0);
        EXPECT_NEAR(station.coefficient, offset, 3 * station.sd) << station.sd;
    }
}

}  // namespace
}  // namespace bemcal::loop
