/// What effects and functions of a model change, input by input.
#include "loop/find_functions.hpp"
#include "loop/given_effects.hpp"
#include "loop/period_hours.hpp"
#include "loop/windy_case.hpp"

#include <algorithm>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;

namespace {

/// W/m2 more at all hours, as a function says it.
FoundFunction constant_gains(double watts) {
    FoundFunction function;
    function.at = test::gains_of_the_morning();
    function.at.shape = {};
    function.at.driver = effects::Driver::one;
    function.at.typical = 1;
    function.basis = functions::constant();
    function.mean = {watts};
    return function;
}

/// 10 W/m2 of gas in the morning that heat nothing.
effects::Effect gas_of_the_morning() {
    effects::Effect effect = test::gains_of_the_morning();
    effect.hook = effects::Hook::meter_addition;
    effect.meter = physics::Quantity::gas;
    return effect;
}

/// A building with an effect, and with functions.
std::vector<study::GivenEffect> given_with(const std::vector<FoundFunction>& functions) {
    study::Case made = test::windy_case();
    test::measure(made, gas_of_the_morning(), 10, 3);
    LoopOptions options;
    options.try_structures = false;
    const LoopData data(made, options);
    LoopResult result;
    result.baseline = make_baseline(data);
    result.functions = functions;
    result.last = result.baseline.chosen;
    result.last.model.effects = {gas_of_the_morning()};
    const Place place = place_in(data, result.last, functions, data.drive);
    result.last.built = build(place, result.last.model.effects);
    result.last.fit.at.x.push_back(10 / result.last.built.unknowns.back().scale);
    return given_effects(data, result);
}

}  // namespace

// Both bring loads of their own: what one brings is not laid to the other.
TEST(GivenEffects, FunctionsAreWhatTheyBringBesideAnEffect) {
    const auto given = given_with({constant_gains(2)});
    ASSERT_EQ(given.size(), 2U);
    EXPECT_EQ(given[1].name, "functions");
    ASSERT_EQ(given[0].at.size(), 1U);
    ASSERT_EQ(given[1].at.size(), 1U);
    EXPECT_EQ(given[0].at[0].hook, "meter addition");
    EXPECT_EQ(given[1].at[0].hook, "gains");
    for (std::size_t hour = 0; hour < 48; ++hour) {
        const std::size_t of_day = hour % 24;
        EXPECT_NEAR(given[0].at[0].values[hour], of_day >= 5 && of_day < 9 ? 10 : 0,
                    1e-9);
        EXPECT_NEAR(given[1].at[0].values[hour], 2, 1e-9);
    }
}

TEST(GivenEffects, WithoutFunctionsNoneAreGiven) {
    EXPECT_EQ(given_with({}).size(), 1U);
}
