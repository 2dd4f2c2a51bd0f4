#include "loop/intervals.hpp"
#include "loop/windy_model.hpp"

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
    const test::WindyModel model(the_right_one);
    const auto sds = deviations_of(model.data, model.standing, 1),
               wider = deviations_of(model.data, model.standing, 4);
    for (std::size_t k = 0; k < sds.size(); ++k) EXPECT_GE(wider[k], 0.999 * sds[k]);
    EXPECT_GT(wider.back(), 1.2 * sds.back());
}

TEST(LoopIntervals, WhatAddsToADeviationAddsInSquares) {
    Found found;
    EXPECT_DOUBLE_EQ(deviation_of(found, 0.3, 0), 0.3);
    EXPECT_DOUBLE_EQ(deviation_of(found, 0, 2), 0.16);  // 8 % of the model's own
    EXPECT_DOUBLE_EQ(deviation_of(found, 0, -2), 0.16);
    found.of_shape = 0.3;
    found.of_missing = 0.4;
    EXPECT_DOUBLE_EQ(deviation_of(found, 1.2, 0), 1.3);
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
