#include "loop/power.hpp"
#include "loop/windy_model.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;

namespace {

PowerTable power_of_building(const Case& made) {
    const LoopData data(made, test::WindyModel::options());
    const Place place = make_place(data, {}, data.drive);
    const Standing standing =
        calibrate(data, place, {}, std::vector<double>(place.unknowns.size()));
    return power_of(data, place, standing);
}

const Power* row_of(const PowerTable& table, const std::string& name) {
    const auto row = std::ranges::find(table.rows, name, &Power::name);
    return row == table.rows.end() ? nullptr : &*row;
}

/// The gas meter, and one of heating with errors as a share of what it reads.
Case with_two_meters(double error = 0.12) {
    Case made = test::WindyModel::measured();
    Meter heating = made.meters[0];
    heating.name = "heating";
    heating.quantity = physics::Quantity::heating;
    const double efficiency = made.building.plant.heating_efficiency.value;
    Stream random(5, 0, 0);
    for (double& value : heating.values)
        value *= efficiency * (1 + error * sampling::standard_normal(random));
    made.meters.push_back(heating);
    return made;
}

TEST(LoopPower, OfOneMeterAnEffectHasItsOwnName) {
    const PowerTable table = power_of_building(test::WindyModel::measured());
    ASSERT_NE(row_of(table, "step of a meter"), nullptr);
    ASSERT_NE(row_of(table, "wind infiltration"), nullptr);
    for (const Power& row : table.rows) EXPECT_EQ(row.name, row.effect.name);
}

// What one meter shows wrongly is seen there alone: worse the more that one errs.
TEST(LoopPower, EachMetersStepIsARow) {
    const PowerTable quiet = power_of_building(with_two_meters(0.1)),
                     noisy = power_of_building(with_two_meters(0.4));
    const auto fall_of = [&](const char* name) {
        const Power *before = row_of(quiet, name), *after = row_of(noisy, name);
        return before && after ? before->detectability / after->detectability
                               : std::nan("");
    };
    EXPECT_EQ(row_of(quiet, "step of a meter"), nullptr);
    EXPECT_NE(row_of(quiet, "standing losses"), nullptr);
    EXPECT_GT(fall_of("step of a meter (heating meter)"), 1.4);
    EXPECT_LT(fall_of("step of a meter (gas meter)"), 1.2);
}

TEST(LoopPower, FacadesShareARowMetersDoNot) {
    effects::Effect north = test::named("shade in a season"), south = north;
    north.facade = 0;
    south.facade = 1;
    EXPECT_TRUE(are_of_one_row(north, north));
    EXPECT_TRUE(are_of_one_row(north, south));
    effects::Effect gas = test::named("step of a meter"), heating = gas;
    gas.meter = physics::Quantity::gas;
    heating.meter = physics::Quantity::heating;
    EXPECT_TRUE(are_of_one_row(gas, gas));
    EXPECT_FALSE(are_of_one_row(gas, heating));
}

TEST(LoopPower, ARowIsOfTheMeterInItsName) {
    int n = 0;
    for (const Power& row : power_of_building(with_two_meters()).rows) {
        if (row.name == row.effect.name) continue;
        EXPECT_EQ(row.name, row.effect.name + " (" + row.effect.place_name + ")");
        ++n;
    }
    EXPECT_EQ(n, 4);  // step and scale, of each
}

}  // namespace

TEST(LoopPower, FromFiveStandardErrorsOnAnEffectCanBeSeen) {
    Power power;
    power.detectability = 5;
    EXPECT_TRUE(can_be_seen(power));
    power.detectability = 4.99;
    EXPECT_FALSE(can_be_seen(power));
}

TEST(LoopPower, ParametersThatFollowItByNinetyEightPercentAreOneClassWithIt) {
    Power power;
    power.visibility = 1 - 0.981 * 0.981;
    EXPECT_TRUE(is_in_parameters(power));
    power.visibility = 1 - 0.979 * 0.979;
    EXPECT_FALSE(is_in_parameters(power));
}
