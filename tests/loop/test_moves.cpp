#include "loop/moves.hpp"
#include "loop/windy_model.hpp"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;
using test::measure, test::named, test::windy_case;

namespace {

/// Calibrated with what is there, and with an effect that nothing in the readings
/// follows.
struct Model : test::WindyModel {
    Model() : WindyModel({"exhaust fan", "wind infiltration"}) {}
};

/// Readings of a building with an effect, and the fit of a model that has one, or another
/// shape of it.
struct Measured {
    Measured(const effects::Effect& there, double coefficient)
        : data(with(there, coefficient), Model::options()),
          place(make_place(data, {}, data.drive)) {}
    static Case with(const effects::Effect& there, double coefficient) {
        Case made = windy_case();
        measure(made, there, coefficient, 3);
        return made;
    }
    Standing calibrated_with(const effects::Effect& effect) const {
        return calibrate(data, place, {{}, {effect}},
                         std::vector<double>(place.unknowns.size() + 1, 0.0));
    }
    effects::Effect best_shape_of(const effects::Effect& effect) const {
        return with_best_shape(data, place, calibrated_with(effect), 0).model.effects[0];
    }

    LoopData data;
    Place place;
};

std::vector<std::string> names_of(const std::vector<effects::Effect>& effects) {
    std::vector<std::string> names;
    for (const effects::Effect& effect : effects) names.push_back(effect.name);
    return names;
}

std::vector<std::string> names_of(const std::vector<Gone>& all) {
    std::vector<std::string> names;
    for (const Gone& gone : all) names.push_back(gone.name);
    return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST(LoopMoves, AnEffectThatCarriesNothingLeaves) {
    Model model;
    const auto gone = prune(model.data, model.place, model.standing, 10);
    EXPECT_EQ(names_of(gone), Names{"exhaust fan"});
    EXPECT_EQ(gone[0].index, 0U);
    EXPECT_EQ(names_of(model.standing.model.effects), Names{"wind infiltration"});
}

TEST(LoopMoves, EffectsThatCarryTooLittleLeaveTheLeastFirst) {
    Model model;
    EXPECT_EQ(names_of(prune(model.data, model.place, model.standing, 1e9)),
              (Names{"exhaust fan", "wind infiltration"}));
    EXPECT_TRUE(model.standing.model.effects.empty());
    EXPECT_EQ(model.standing.fit.at.x.size(), model.place.unknowns.size());
}

// Wherever the parameters stood for it.
TEST(LoopMoves, WhatIsLeftIsTheSameWhereverAnEffectLeaves) {
    Model model;
    Standing best = model.standing;
    ASSERT_TRUE(take_out(model.data, model.place, best, 0));
    Standing led = model.standing;
    std::vector<double> elsewhere = led.fit.at.x;
    for (std::size_t k = 0; k < led.built.first_effect(); ++k)
        elsewhere[k] = led.built.unknowns[k].highest();
    refit(model.data, led, elsewhere, only_derivatives);
    ASSERT_FALSE(led.fit.failed);
    ASSERT_TRUE(take_out(model.data, model.place, led, 0));
    EXPECT_NEAR(led.coefficient(0), best.coefficient(0), 0.002);
    EXPECT_LT(evidence(model.data, led, best), 1);
}

TEST(LoopMoves, AnEffectLeavesWhoseCoefficientIsNoLongerPlausible) {
    Model model;
    prune(model.data, model.place, model.standing, 10);
    EXPECT_TRUE(prune_implausible(model.data, model.place, model.standing).empty());
    model.standing.model.effects[0].most = 0.01;
    EXPECT_EQ(names_of(prune_implausible(model.data, model.place, model.standing)),
              Names{"wind infiltration"});
    EXPECT_TRUE(model.standing.model.effects.empty());
}

// What the first two weeks owe to a state that nobody knows looks like a step there; what
// the last two show would go on for ever.
TEST(LoopMoves, AStepAtAnEndOfTheReadingsLeaves) {
    Model model;
    prune(model.data, model.place, model.standing, 10);
    effects::Effect& effect = model.standing.model.effects[0];
    effect.driver = effects::Driver::elapsed;
    effect.shape = {effects::Form::over, 0.041};
    EXPECT_FALSE(is_at_an_end(model.data, effect));
    EXPECT_TRUE(prune_implausible(model.data, model.place, model.standing).empty());
    const Period& training = model.data.training();
    const std::chrono::duration<double, std::chrono::years::period> years =
        training.to - training.from;
    effect.shape.at = years.count() - 0.041;
    EXPECT_FALSE(is_at_an_end(model.data, effect));
    effect.shape.at = years.count() - 0.039;
    EXPECT_TRUE(is_at_an_end(model.data, effect));
    effect.shape.at = 0.04;
    EXPECT_TRUE(is_at_an_end(model.data, effect));
    EXPECT_EQ(names_of(prune_implausible(model.data, model.place, model.standing)),
              Names{"wind infiltration"});
    effects::Effect drift;
    drift.driver = effects::Driver::elapsed;  // has no date
    EXPECT_FALSE(is_at_an_end(model.data, drift));
}

// Nothing of wind infiltration's form can move. Of a fan by the hour it can: shapes that
// fit nearly as well leave its coefficient open, the more the wider the misfit.
TEST(LoopMoves, ShapesLeaveCoefficientsOpen) {
    Model model;
    EXPECT_EQ(deviation_over_shapes(model.data, model.place, model.standing, 1, 1), 0);
    const Measured measured(named("exhaust fan on weekdays"), 1.5);
    const Standing standing = measured.calibrated_with(named("exhaust fan on weekdays"));
    const auto deviation = [&](double misfit) {
        return deviation_over_shapes(measured.data, measured.place, standing, 0, misfit);
    };
    const double exact = deviation(1), open = deviation(1000);
    EXPECT_GE(exact, 0);
    EXPECT_GT(open, exact);
    EXPECT_LT(open, std::abs(standing.coefficient(0)));
}

TEST(LoopMoves, NothingLeavesThatCarriesMoreThanIsAsked) {
    Model model;
    EXPECT_TRUE(prune(model.data, model.place, model.standing, -1e9).empty());
    EXPECT_EQ(model.standing.model.effects.size(), 2U);
}

// The catalogue has seasons that begin with a month; what is there begins eight days
// later.
TEST(LoopMoves, DatesMoveToTheDay) {
    effects::Effect season = named("heating set-point of a season");
    season.shape = {effects::Form::within, 128, 243};
    const Measured measured(season, -3);
    season.shape.at = 120;
    const Standing standing = measured.calibrated_with(season);
    const Standing moved = with_best_shape(measured.data, measured.place, standing, 0);
    EXPECT_NEAR(moved.model.effects[0].shape.at, 128, 1);
    EXPECT_GT(evidence(measured.data, standing, moved), 10);
    EXPECT_TRUE(is_dated(season));
    EXPECT_FALSE(is_dated(named("wind infiltration")));
}

// A controller may know any hours: the catalogue's six windows are where moves begin.
TEST(LoopMoves, HoursOfASetPointMove) {
    effects::Effect evening = named("heating set-point of some hours");
    evening.shape = {effects::Form::within, 16, 23};
    const Measured measured(evening, 2);
    evening.shape = {effects::Form::within, 15, 21};
    const Standing moved = with_best_shape(measured.data, measured.place,
                                           measured.calibrated_with(evening), 0);
    EXPECT_NEAR(moved.model.effects[0].shape.at, 16, 0.5);
    EXPECT_NEAR(moved.model.effects[0].shape.until, 23, 0.5);
    EXPECT_NEAR(moved.coefficient(0), 2, 0.3);
    EXPECT_TRUE(is_set_point_window(evening));
    EXPECT_FALSE(is_set_point_window(named("exhaust fan")));
    EXPECT_FALSE(is_set_point_window(named("heating set-point of a season")));
}

// What is set for less than three hours is the plant's start: windows do not shrink
// there.
TEST(LoopMoves, ASetPointIsKeptForThreeHours) {
    effects::Effect morning = named("heating set-point of some hours");
    morning.shape = {effects::Form::within, 6, 7.5};
    const Measured measured(morning, 4);
    morning.shape = {effects::Form::within, 5, 8.5};
    const effects::Shape shape = measured.best_shape_of(morning).shape;
    EXPECT_GE(shape.until - shape.at, 3);
    EXPECT_LE(shape.until - shape.at, 3.25);  // but they shrink as far as that
    // Through midnight, too.
    effects::Effect night = morning;
    night.shape = {effects::Form::within, 22, 1.5};
    const effects::Shape moved = measured.best_shape_of(night).shape;
    EXPECT_GE(std::fmod(moved.until - moved.at + 24, 24), 3);
}

// Parameters that stand for an effect hold a fit that starts from them: half of what is
// there, in another valley.
TEST(LoopMoves, AFitThatStartsAgainIsKeptWhereItExplainsMore) {
    const Measured measured(named("wind infiltration"), 0.08);
    const Standing best = measured.calibrated_with(named("wind infiltration"));
    Standing same = best;
    EXPECT_FALSE(start_again(measured.data, measured.place, same));
    EXPECT_EQ(same.fit.at.x, best.fit.at.x);
    Standing stuck = best;
    std::vector<double> elsewhere = best.fit.at.x;
    for (double& x : elsewhere) x += 1.5;
    refit(measured.data, stuck, elsewhere, {0, 0});
    ASSERT_GT(evidence(measured.data, stuck, best), 10);
    EXPECT_TRUE(start_again(measured.data, measured.place, stuck));
    EXPECT_NEAR(stuck.coefficient(0), best.coefficient(0), 0.01);
}

// Plant and use follow another day to the same degree: either half may leave, and the
// other says what is there.
TEST(LoopMoves, AHalfStandsForBothWhereTheOtherLeaves) {
    const effects::Effect whole = named("Saturdays worked");
    Case made = windy_case();
    measure(made, whole, 0.8, 3);
    const LoopData data(made, Model::options());
    const Place place = make_place(data, {}, data.drive);
    effects::Effect plant = whole, use = whole;
    plant.hook = effects::Hook::plant_operation;
    use.hook = effects::Hook::occupation;
    use.name += suffix_of_use;
    for (const auto& halves : {std::vector{plant, use}, std::vector{use, plant}}) {
        Standing standing = calibrate(data, place, {{}, halves},
                                      std::vector<double>(place.unknowns.size() + 2, 0));
        EXPECT_EQ(prune(data, place, standing, 10).size(), 1U);
        ASSERT_EQ(names_of(standing.model.effects), Names{whole.name});
        EXPECT_EQ(standing.model.effects[0].hook, effects::Hook::operation);
        EXPECT_NEAR(standing.coefficient(0), 0.8, 0.1);
    }
}

// Two meters of one gas flow that disagree: what one gains the other loses.
TEST(LoopMoves, NoMeterPaysForWhatIsMendedAtAnother) {
    Case made = test::WindyModel::measured();
    made.meters.push_back(made.meters[0]);
    for (double& value : made.meters[1].values) value *= 1.1;
    const LoopData data(made, test::WindyModel::options());
    const Place place = make_place(data, {}, data.drive);
    const Standing before =
        calibrate(data, place, {}, std::vector<double>(place.unknowns.size()));
    Standing after = before;
    after.noise[1].sigma /= 3;
    refit(data, after, after.fit.at.x, {10, 1e-4});
    const auto error_of_first = [&](const Standing& standing) {
        return mean_squares(data.targets, standing.residuals)[0];
    };
    ASSERT_GT(error_of_first(after), 1.02 * error_of_first(before));
    const auto noise = after.noise;
    spare_meters(data, before, after);
    EXPECT_LE(error_of_first(after), 1.005 * error_of_first(before));
    EXPECT_EQ(after.noise[0].sigma, noise[0].sigma);
}
