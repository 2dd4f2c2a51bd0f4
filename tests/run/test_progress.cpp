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

StageWords in_round(int round) {
    StageWords words;
    words.stage = "office/posterior";
    words.round = round;
    words.n_threads = 2;
    return words;
}

TEST(Progress, OfKnownSimulationsCountsThemAndTheirRate) {
    EXPECT_EQ(progress_text({"office/screening", 800}, half_way()),
              "office/screening: 4 of 8 items, 397 ok, 3 failed, 20/s, 0:20 left");
}

TEST(Progress, OfAStageThatGoesOnInRoundsCountsItemsOfTheRound) {
    EXPECT_EQ(
        progress_text(in_round(3), half_way()),
        "office/posterior: round 3: 4 of 8 items, 3 failed, 0:20 left in this round");
}

TEST(Progress, SaysNothingOfTheTimeLeftBeforeAnItemIsDone) {
    Progress progress = half_way();
    progress.items_known = 4;  // by an earlier run
    EXPECT_EQ(progress_text(in_round(1), progress),
              "office/posterior: round 1: 4 of 8 items, 3 failed");
}

TEST(Progress, OfItemsThatRunTellsTheTimeLeftByTheirShare) {
    Progress progress = half_way();
    progress.items_known = 4;
    // Two of the four that are left run, and are half done: one item in 20 s, three left.
    EXPECT_EQ(progress_text(in_round(1), progress, {0.5, "draw 10 of 20"}),
              "office/posterior: round 1: 4 of 8 items, 3 failed, 1:00 left in this "
              "round; draw 10 of 20");
    progress.items_done = 7;  // of the one that is left not two can run
    EXPECT_EQ(progress_text(in_round(1), progress, {0.5, ""}),
              "office/posterior: round 1: 7 of 8 items, 3 failed, 0:03 left in this "
              "round");
}

TEST(Progress, OfBuildingsHasTheirRate) {
    StageWords words = in_round(2);
    words.stage = "stock";
    words.items = "buildings";
    EXPECT_EQ(progress_text(words, half_way()),
              "stock: round 2: 4 of 8 buildings, 3 failed, 12 buildings a minute, 0:20 "
              "left in this round");
}

}  // namespace
}  // namespace bemcal::run
