/// What an effect brings to the meters is what they show with it and not without.
#include "loop/effect_values.hpp"
#include "loop/intervals.hpp"
#include "loop/windy_model.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

const std::vector<std::string> by_wind = {"wind infiltration"};

/// Of a year's gas when it has so much wind in it [kWh].
double gas_with(double coefficient) {
    study::Case made = test::windy_case();
    test::measure(made, test::named(by_wind[0]), coefficient, 3);
    const auto readings = training_readings(made, made.periods[0]);
    double sum = 0;
    for (const double value : readings[0].values) sum += std::isnan(value) ? 0 : value;
    return sum;
}

std::vector<std::vector<Worth>> worth_in(const test::WindyModel& model) {
    return worth_of_effects(model.data, model.place, model.standing,
                            deviations_of(model.data, model.standing, 1), 1,
                            accounts_of(model.data));
}

TEST(EffectValues, AreTheEnergyThatWasPlanted) {
    const test::WindyModel model(by_wind);
    const Worth gas = worth_in(model)[0][0];
    const double scale = accounts_of(model.data)[0].per_reading[0];
    const double planted = scale * (gas_with(0.08) - gas_with(0));
    EXPECT_GT(planted, 0);
    EXPECT_NEAR(gas.mean, planted, 0.1 * planted);
    EXPECT_LT(gas.least, gas.mean);
    EXPECT_GT(gas.most, gas.mean);
    // Three halves of the interval are five deviations.
    EXPECT_NEAR(gas.mean, planted, 3 * (gas.most - gas.mean));
}

/// Of leaks that were opened so many years after the begin, all else alike.
double gas_of_leaks_from(const test::WindyModel& model, double at) {
    LoopModel with;
    with.effects = {test::named("leaks sealed or opened")};
    with.effects[0].shape.at = at;
    std::vector<double> x(model.place.unknowns.size() + 1);
    Standing standing = calibrate(model.data, model.place, with, x);
    x.back() = 1;
    standing.fit.at.x = x;
    return worth_of_effects(model.data, model.place, standing,
                            deviations_of(model.data, standing, 1), 1,
                            accounts_of(model.data))[0][0]
        .mean;
}

TEST(EffectValues, OfWhatBeganOnADateAreOfAllTheTime) {
    const test::WindyModel model({});
    const double from_the_begin = gas_of_leaks_from(model, -1);
    EXPECT_GT(from_the_begin, 0);
    EXPECT_EQ(gas_of_leaks_from(model, 0.25), from_the_begin);
}

TEST(EffectValues, AreTheSameAgain) {
    const test::WindyModel model(by_wind);
    const Worth one = worth_in(model)[0][0], two = worth_in(model)[0][0];
    EXPECT_EQ(one.least, two.least);
    EXPECT_EQ(one.most, two.most);
}

TEST(EffectValues, AreOfAYearFromThreeHundredDaysOn) {
    EXPECT_FALSE(per_year(299.9));
    EXPECT_EQ(per_year(300), 365.25 / 300);
    EXPECT_EQ(per_year(365.25), 1);
    EXPECT_EQ(per_year(730.5), 0.5);
    const test::WindyModel model(by_wind);
    EXPECT_EQ(accounts_of(model.data)[0].unit, "kWh");  // 103 days
}

TEST(EffectValues, AreCountedInMoneyWhereATariffIsKnown) {
    study::Case made = test::WindyModel::measured();
    const auto accounts_with = [&](double tariff, double co2) {
        for (study::Meter& meter : made.meters) meter.tariff = tariff, meter.co2 = co2;
        return accounts_of(LoopData(made, test::WindyModel::options()));
    };
    const double unknown = std::nan("");
    const auto energy = accounts_with(unknown, unknown);
    EXPECT_EQ(accounts_with(0.2, unknown).size(), energy.size() + 1);
    const auto all = accounts_with(0.2, 0.3);
    ASSERT_EQ(all.size(), energy.size() + 2);
    EXPECT_EQ(all[all.size() - 2].of, "cost");
    EXPECT_EQ(all.back().of, "CO2");
    EXPECT_DOUBLE_EQ(all.back().per_reading[0], 0.3 * energy[0].per_reading[0]);
    EXPECT_EQ(accounts_with(0, 0).size(), energy.size());
}

// A meter without a tariff is not free: the sum says of which meters it is.
TEST(EffectValues, SayOfWhichMetersTheCostIsWhereSomeHaveNoTariff) {
    study::Case made = test::WindyModel::measured();
    study::Meter other = made.meters.front();
    made.meters.front().tariff = 0.2;
    other.name = "second";
    other.quantity = physics::Quantity::gas;
    made.meters.push_back(other);
    const LoopData data(made, test::WindyModel::options());
    EXPECT_EQ(accounts_of(data).back().of,
              "cost of " + made.meters.front().name + " alone");
}

}  // namespace
}  // namespace bemcal::loop
