#include "loop/decisions.hpp"
#include "loop/intervals.hpp"
#include "loop/windy_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;

namespace {

const std::vector<std::string> the_right_one = {"wind infiltration"};

}  // namespace

// What was planted lies within three deviations of noise (false alarm: 1 in 370).
TEST(LoopIntervals, NoiseLeavesTheTruthWithinItsDeviations) {
    const test::WindyModel model(the_right_one);
    const auto sds = deviations_of(model.data, model.standing, 1);
    ASSERT_EQ(sds.size(), model.standing.built.unknowns.size());
    EXPECT_GT(sds.back(), 0);
    EXPECT_NEAR(model.standing.coefficient(0), 0.08, 3 * sds.back());
}

TEST(LoopIntervals, TheyWidenWithTheMisfit) {
    const test::WindyModel model({});
    const auto sds = deviations_of(model.data, model.standing, 1),
               wider = deviations_of(model.data, model.standing, 4);
    double most = 0;
    for (std::size_t k = 0; k < sds.size(); ++k) {
        EXPECT_GE(wider[k], 0.999 * sds[k]);
        most = std::max(most, wider[k] / sds[k]);
    }
    EXPECT_GT(most, 1.2);
}

// Eight tenths of what the effect does a parameter can do: six tenths are left to tell
// it.
TEST(LoopIntervals, TheModelsErrorCountsByWhatNoParameterCanDo) {
    test::WindyModel model(the_right_one);
    Standing& standing = model.standing;
    const std::size_t effect = standing.built.first_effect();
    std::ranges::fill(standing.residuals, 0.0);
    Matrix& slopes = standing.fit.at.derivatives;
    std::ranges::fill(slopes.values, 0.0);
    slopes(0, 100) = 1e9;
    slopes(effect, 100) = 0.8e9;
    slopes(effect, 101) = 0.6e9;
    const auto sds = deviations_of(model.data, standing, 1);
    const double sd =
        standing.coefficient(0) *
        std::hypot(decisions::error_of_model, decisions::error_beside_others / 0.6);
    EXPECT_NEAR(sds[effect], sd, 1e-3 * sd);
    const auto& unknowns = standing.built.unknowns;
    const double follows = 0.8 * sd / unknowns[effect].scale * unknowns[0].scale;
    EXPECT_NEAR(sds[0], follows, 1e-3 * follows);
    standing.fit.at.x[effect] *= -1;
    EXPECT_NEAR(deviations_of(model.data, standing, 1)[effect], sd, 1e-3 * sd);
}

TEST(LoopIntervals, WhatAddsToADeviationAddsInSquares) {
    Found found;
    EXPECT_DOUBLE_EQ(deviation_of(found, 0.3), 0.3);
    found.of_shape = 0.3;
    found.of_missing = 0.4;
    EXPECT_DOUBLE_EQ(deviation_of(found, 1.2), 1.3);
}

TEST(LoopIntervals, UnknownsGoTogetherBetweenMinusOneAndOne) {
    const test::WindyModel model(the_right_one);
    const Matrix all = correlations_of(model.data, model.standing, 1);
    for (std::size_t i = 0; i < all.rows; ++i) {
        EXPECT_DOUBLE_EQ(all(i, i), 1);
        for (std::size_t k = 0; k < all.cols; ++k) {
            EXPECT_NEAR(all(i, k), all(k, i), 1e-12);
            EXPECT_LE(std::abs(all(i, k)), 1 + 1e-12);
        }
    }
}
