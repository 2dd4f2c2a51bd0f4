#include "loop/settings.hpp"
#include "loop/windy_case.hpp"

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::test;

namespace {

/// A shift of one setting or several by 1 K as a standard deviation.
struct Shift {
    physics::Building building = windy_case().building;
    physics::Parameter parameter{"shift", "K", -4, 4, physics::Effect::offset, {}, 0};
    study::FitUnknown unknown{"shift", "K", 0, 1, -4, 4, true};

    explicit Shift(const std::string& path) {
        parameter.targets = physics::resolve(building, path);
    }
    std::optional<Setting> denied(double x, double deviation = 0.2) const {
        return denied_setting(building, parameter, unknown, x, deviation);
    }
};

}  // namespace

TEST(Settings, OneIsDeniedBeyondThreeDeviationsOfItsPrior) {
    const Shift shift("zone.*.heating_set_point");
    EXPECT_FALSE(shift.denied(3));
    EXPECT_FALSE(shift.denied(-3));
    const auto denied = shift.denied(-3.1);
    ASSERT_TRUE(denied);
    const double described =
        physics::number_at(shift.building, shift.parameter.targets.front());
    EXPECT_EQ(denied->name, "heating set-point");
    EXPECT_EQ(denied->parameter, "shift");
    EXPECT_DOUBLE_EQ(denied->described, described);
    EXPECT_DOUBLE_EQ(denied->found, described - 3.1);
    EXPECT_NEAR(denied->most - denied->least, 2 * 1.645 * 0.2, 1e-3);
    EXPECT_DOUBLE_EQ(denied->distance, 3.1);
}

// Where it seldom acts, readings hardly hold it: an open question denies nothing.
TEST(Settings, OneThatReadingsHardlyTellIsNotDenied) {
    const Shift shift("zone.*.heating_set_point");
    EXPECT_TRUE(shift.denied(4, 0.5));
    EXPECT_FALSE(shift.denied(4, 0.51));
}

// Of a building that has a value already: a shift is from what is described.
TEST(Settings, AShiftIsFromTheDescription) {
    Shift shift("zone.*.heating_set_point");
    const auto before = shift.denied(-3.1);
    physics::set_nominal(-1, shift.parameter, shift.building);
    const auto denied = shift.denied(-3.1);
    ASSERT_TRUE(before && denied);
    EXPECT_DOUBLE_EQ(denied->described, before->described);
    EXPECT_DOUBLE_EQ(denied->found, before->found);
}

TEST(Settings, AReplacedOneIsDescribedByItsPrior) {
    Shift shift("zone.*.cooling_set_point");
    shift.parameter.effect = physics::Effect::replace;
    shift.unknown = {"shift", "degC", 26, 0.5, 20, 30, true};
    const auto denied = shift.denied(4);
    ASSERT_TRUE(denied);
    EXPECT_EQ(denied->name, "cooling set-point");
    EXPECT_DOUBLE_EQ(denied->described, 26);
    EXPECT_DOUBLE_EQ(denied->found, 28);
}

TEST(Settings, OtherNumbersAndThoseWithoutAPriorAreCalibratedAlone) {
    EXPECT_FALSE(Shift("construction.*.u_value").denied(4));
    Shift shift("zone.*.heating_set_point");
    shift.unknown.has_prior = false;
    EXPECT_FALSE(shift.denied(4));
    shift.unknown.has_prior = true;
    shift.parameter.effect = physics::Effect::factor;
    EXPECT_FALSE(shift.denied(4));
}
