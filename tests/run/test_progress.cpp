#include "run/progress.hpp"

#include <cmath>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

constexpr std::time_t noon = 1795780800;  ///< 2026-11-27 12:00 UTC

/// The time zone of the machine, for the length of a test.
class Zone {
  public:
    explicit Zone(const char* name) {
        if (const char* before = std::getenv("TZ")) before_ = before;
        ::setenv("TZ", name, 1);
        ::tzset();
    }
    ~Zone() {
        if (before_.empty())
            ::unsetenv("TZ");
        else
            ::setenv("TZ", before_.c_str(), 1);
        ::tzset();
    }
    Zone(const Zone&) = delete;
    Zone& operator=(const Zone&) = delete;

  private:
    std::string before_;
};

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
    EXPECT_EQ(progress_text({"office/screening", 800}, half_way(), noon),
              "office/screening: 4 of 8 items, 397 ok, 3 failed, 20/s, 0:20 left");
}

TEST(Progress, OfAStageThatGoesOnInRoundsCountsItemsOfTheRound) {
    EXPECT_EQ(
        progress_text(in_round(3), half_way(), noon),
        "office/posterior: round 3: 4 of 8 items, 3 failed, 0:20 left in this round");
}

TEST(Progress, SaysNothingOfTheTimeLeftBeforeAnItemIsDone) {
    Progress progress = half_way();
    progress.items_known = 4;  // by an earlier run
    EXPECT_EQ(progress_text(in_round(1), progress, noon),
              "office/posterior: round 1: 4 of 8 items, 3 failed");
}

TEST(Progress, OfItemsThatRunTellsTheTimeLeftByTheirShare) {
    const Zone utc("UTC0");
    Progress progress = half_way();
    progress.items_known = 4;
    // Two of the four that are left run, and are half done: one item in 20 s, three left.
    progress.activity = {0.5, "draw 10 of 20", "after 40 draws R-hat 1.020"};
    EXPECT_EQ(progress_text(in_round(1), progress, noon),
              "office/posterior: round 1: 4 of 8 items, 3 failed, 1:00 left in this "
              "round (ends about 12:01); draw 10 of 20; after 40 draws R-hat 1.020");
    progress.items_done = 7;  // of the one that is left not two can run
    progress.activity = {0.5};
    EXPECT_EQ(progress_text(in_round(1), progress, noon),
              "office/posterior: round 1: 7 of 8 items, 3 failed, 0:03 left in this "
              "round");
}

TEST(Progress, OfBuildingsHasTheirRate) {
    StageWords words = in_round(2);
    words.stage = "stock";
    words.items = "buildings";
    EXPECT_EQ(progress_text(words, half_way(), noon),
              "stock: round 2: 4 of 8 buildings, 3 failed, 12 buildings a minute, 0:20 "
              "left in this round");
}

TEST(Progress, TellsWhenItEndsByTheClockOfTheMachine) {
    {
        const Zone utc("UTC0");
        EXPECT_EQ(end_text(noon, 59), "");
        EXPECT_EQ(end_text(noon, std::nan("")), "");
        EXPECT_EQ(end_text(noon, 2 * 3600 + 35 * 60), " (ends about 14:35)");
        EXPECT_EQ(end_text(noon, 12 * 3600), " (ends about 2026-11-28 00:00)");
        EXPECT_EQ(end_text(noon, 40 * 86400), " (ends about 2027-01-06 12:00)");
        EXPECT_NE(end_text(noon, 1e300), "");
    }
    const Zone india("IST-5:30");
    EXPECT_EQ(end_text(noon, 300), " (ends about 17:35)");
    Progress progress = half_way();
    progress.seconds = 3600;
    EXPECT_EQ(progress_text({"office/screening", 800}, progress, noon),
              "office/screening: 4 of 8 items, 397 ok, 3 failed, 0/s, 1:00:00 left (ends "
              "about 18:30)");
}

}  // namespace
}  // namespace bemcal::run
