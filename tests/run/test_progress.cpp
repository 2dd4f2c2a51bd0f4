#include "run/progress.hpp"

#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

Progress half_way() {
    Progress progress;
    progress.items_done = 4;
    progress.items_total = 8;
    progress.points_failed = 3;
    progress.seconds = 20;
    return progress;
}

TEST(Progress, OfKnownSimulationsCountsThemAndTheirRate) {
    EXPECT_EQ(progress_text("office/screening", 800, half_way()),
              "office/screening: 4 of 8 items, 397 ok, 3 failed, 20/s, 0:20 left");
}

TEST(Progress, OfAStageThatGoesOnInRoundsCountsItemsOfTheRound) {
    EXPECT_EQ(
        progress_text("office/posterior", 0, half_way(), 3),
        "office/posterior: round 3: 4 of 8 items, 3 failed, 0:20 left in this round");
}

TEST(Progress, SaysNothingOfTheTimeLeftBeforeAnItemIsDone) {
    Progress progress = half_way();
    progress.items_known = 4;  // by an earlier run
    EXPECT_EQ(progress_text("office/posterior", 0, progress, 1),
              "office/posterior: round 1: 4 of 8 items, 3 failed");
}

}  // namespace
}  // namespace bemcal::run
