/// What a measurement would tell, against the same found in another way.
#include "loop/intervals.hpp"
#include "loop/next_measurements.hpp"
#include "loop/open_questions.hpp"
#include "loop/windy_model.hpp"
#include "stats/least_squares.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::loop {
namespace {

const std::vector<std::string> by_wind = {"wind infiltration"};

std::vector<Found> with_rival(const std::string& rival) {
    Found found{{{by_wind[0]}, {rival}}, "", 100, 10};
    found.rivals = {test::named(rival)};
    return {found};
}

std::vector<Answer> answers_of(const test::WindyModel& model,
                               const std::vector<Found>& found) {
    return next_measurements(model.data, model.place, model.standing, found, 1);
}

std::vector<Answer> of_kind(std::vector<Answer> all, const std::string& kind) {
    std::erase_if(all, [&](const Answer& answer) { return answer.kind != kind; });
    return all;
}

TEST(NextMeasurements, WithoutReadingsTheChanceIsTodays) {
    EXPECT_EQ(chance_to_tell(0, 0), 0.5);
    for (const double so_far : {-4.0, -1.0, 1.0, 4.0, 30.0}) {
        const double now = chance_to_tell(so_far, 0);
        EXPECT_NEAR(now, 1 / (1 + std::exp(-0.5 * std::abs(so_far))), 1e-12);
        EXPECT_NEAR(chance_to_tell(so_far, 1e-6), now, 1e-3);
    }
}

TEST(NextMeasurements, TheFurtherModelsAreApartTheSurerTheRightOneIsTold) {
    double before = 0;
    for (const double apart : {0.0, 0.5, 1.0, 4.0, 16.0, 64.0}) {
        EXPECT_GE(chance_to_tell(2, apart), before);
        EXPECT_NEAR(chance_to_tell(2, apart), chance_to_tell(-2, apart), 1e-12);
        before = chance_to_tell(2, apart);
    }
    EXPECT_GT(before, 0.999);
    // Two normal densities a distance of 2 apart: each is told in 84 of 100.
    EXPECT_NEAR(chance_to_tell(0, 4), 0.8413, 1e-4);
}

/// Index of the one that is advised; -1 = none.
int advised_of(const std::string& kind, double now, const std::vector<double>& then) {
    std::vector<Answer> answers;
    answers.reserve(then.size());
    for (const double one : then)
        answers.push_back({"question", kind, "reading", "1 May", 1, now, one});
    advise(answers);
    const auto found = std::ranges::find(answers, 1.0, &Answer::is_advised);
    return found == answers.end() ? -1 : static_cast<int>(found - answers.begin());
}

TEST(NextMeasurements, TheCheapestThatIsEnoughIsAdvisedElseTheBest) {
    EXPECT_EQ(advised_of("name", 0.6, {0.7, 0.951, 0.99}), 1);
    EXPECT_EQ(advised_of("name", 0.6, {0.7, 0.949, 0.948}), 1);  // the best
    EXPECT_EQ(advised_of("name", 0.6, {0.7, 0.949, 0.95}), 2);
    EXPECT_EQ(advised_of("parameter", 0.8, {0.7, 0.4, 0.1}), 1);
    EXPECT_EQ(advised_of("parameter", 0.8, {0.7, 0.401, 0.3}), 2);
}

TEST(NextMeasurements, ANameThatIsToldAlreadyNeedsNoMeasurement) {
    EXPECT_EQ(advised_of("name", 0.951, {0.99, 1}), -1);
    EXPECT_EQ(advised_of("name", 0.949, {0.99, 1}), 0);
}

TEST(NextMeasurements, WhatTellsHardlyMoreIsNotAdvised) {
    EXPECT_EQ(advised_of("name", 0.6, {0.6, 0.639}), -1);  // a tenth of the doubt is 0.04
    EXPECT_EQ(advised_of("name", 0.6, {0.6, 0.641}), 1);
    EXPECT_EQ(advised_of("parameter", 0.8, {0.8, 0.721}), -1);
    EXPECT_EQ(advised_of("parameter", 0.8, {0.8, 0.719}), 1);
    EXPECT_EQ(advised_of("parameter", 0.8, {}), -1);
}

TEST(NextMeasurements, ANameThatIsNotTheNearestIsAsked) {
    const test::WindyModel model(by_wind);
    const auto names =
        of_kind(answers_of(model, with_rival("stack infiltration")), "name");
    ASSERT_FALSE(names.empty());
    for (const Answer& answer : names) {
        EXPECT_EQ(answer.question, "wind infiltration, or stack infiltration?");
        EXPECT_GE(answer.then, answer.now - 1e-12);
        EXPECT_LE(answer.then, 1);
    }
    const auto longer = [](const Answer& one, const Answer& other) {
        return one.measure == other.measure && one.weeks < other.weeks;
    };
    for (const Answer& one : names)
        for (const Answer& other : names)
            if (longer(one, other)) {
                EXPECT_GE(other.then, one.then - 0.02);
            }
}

TEST(NextMeasurements, OneOfEachQuestionIsAdvisedAtMost) {
    const test::WindyModel model(by_wind);
    const auto all = answers_of(model, with_rival("stack infiltration"));
    for (const Answer& answer : all)
        EXPECT_LE(std::ranges::count_if(all,
                                        [&](const Answer& other) {
                                            return other.question == answer.question &&
                                                   other.is_advised == 1;
                                        }),
                  1);
}

TEST(NextMeasurements, WhatIsReadIsNoNewReading) {
    const test::WindyModel model(by_wind);
    for (const Answer& answer : answers_of(model, with_rival("stack infiltration"))) {
        EXPECT_NE(answer.measure, "gas by the hour");
        EXPECT_NE(answer.measure, "district heat by the hour");  // there is none
    }
}

/// Of parameters that are known well already the readings say little more.
study::Case with_narrow_priors() {
    study::Case made = test::WindyModel::measured();
    for (study::ParameterPrior& prior : made.priors) prior.prior.b *= 0.02;
    return made;
}

/// The same meters read on: the weeks' rows of the derivatives count twice.
TEST(NextMeasurements, AParameterIsAsWideAsTheLongerReadingsSay) {
    const LoopData data(with_narrow_priors(), test::WindyModel::options());
    const Place place = make_place(data, {}, data.drive);
    const Standing last =
        calibrate(data, place, {}, std::vector<double>(place.unknowns.size()));
    const auto all = of_kind(next_measurements(data, place, last, {}, 1), "parameter");
    const auto own = std::ranges::find_if(all, [](const Answer& answer) {
        return answer.measure == "the same meters, read on" && answer.weeks == 2;
    });
    ASSERT_NE(own, all.end());
    const auto& unknowns = last.built.unknowns;
    const auto k = static_cast<std::size_t>(
        std::ranges::find(unknowns, own->question, &study::FitUnknown::name) -
        unknowns.begin());
    ASSERT_LT(k, unknowns.size());
    auto diagonal = study::prior_diagonal(unknowns);
    for (double& entry : diagonal) entry += 1e-6;
    const auto sd_with = [&](const std::vector<double>& weights) {
        const auto equations =
            stats::normal_equations(last.fit.at.derivatives, last.residuals, weights);
        return std::sqrt(stats::inverse(equations.matrix, diagonal,
                                        std::vector<char>(diagonal.size(), 0))(k, k));
    };
    auto weights = weights_of(data.targets, last.noise);
    EXPECT_NEAR(own->now, sd_with(weights), 1e-6);
    double narrowest = own->now;
    for (std::size_t h = 0; h + 14 * 24 <= data.begins.size(); ++h) {
        const auto label = physics::calendar_step(data.begins[h]);
        if (label.day != 1 || label.hour != 0) continue;
        auto longer = weights;
        for (std::size_t i = h; i < h + 14 * 24; ++i) longer[i] += last.noise[0].weight();
        narrowest = std::min(narrowest, sd_with(longer));
    }
    EXPECT_NEAR(own->then, narrowest, 1e-6);
    EXPECT_LT(own->then, own->now);
}

TEST(NextMeasurements, ParametersAreWideFromHalfOfTheirPriorOn) {
    const test::WindyModel model(by_wind);
    const std::size_t n = model.standing.built.unknowns.size();
    std::vector<double> sds(n, 0.5);
    EXPECT_TRUE(wide_parameters(model.data, model.standing, sds).empty());
    sds[0] = 0.5001;
    EXPECT_EQ(wide_parameters(model.data, model.standing, sds),
              std::vector<std::size_t>{0});
    sds.assign(n, 1);  // the effect's coefficient is no parameter of the job
    EXPECT_EQ(wide_parameters(model.data, model.standing, sds).size(), n - 1);
}

}  // namespace
}  // namespace bemcal::loop
