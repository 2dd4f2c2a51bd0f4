#include "study/activity.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

TEST(Activity, OfAllRanksIsThatOfAMeanItem) {
    const Activity all = of_all({{0.5, "", "", 3}, {0.1, "", "", 1}});
    EXPECT_DOUBLE_EQ(all.share, 0.4);
    EXPECT_EQ(all.n_items, 4);
}

TEST(Activity, OfAllRanksTellsTheOneThatIsLeastFar) {
    const Activity all = of_all(
        {{0.5, "draw 50", "R-hat 1.02", 1}, {0.1, "draw 10", "", 1}, {0, "", "", 0}});
    EXPECT_EQ(all.text, "draw 10");
    EXPECT_EQ(all.so_far, "R-hat 1.02");
}

TEST(Activity, OfRanksThatAreEquallyFarTellsEachOnceAndCountsTheRest) {
    EXPECT_EQ(of_all({{0, "draw 0", "", 1}, {0, "draw 0", "", 1}}).text, "draw 0");
    std::vector<Activity> ranks;
    for (const char* text : {"a", "b", "c", "d", "e", "f"})
        ranks.push_back({0, text, "", 1});
    EXPECT_EQ(of_all(ranks).text, "a; b; c; d; and of 2 ranks more");
}

TEST(Activity, WithoutItemsTellsWhatHasFinishedAlone) {
    const Activity all = of_all({{0, "", "best 0.2", 0}, {0, "", "", 0}});
    EXPECT_EQ(all.text, "");
    EXPECT_EQ(all.so_far, "best 0.2");
    EXPECT_EQ(all.share, 0);
}

}  // namespace
}  // namespace bemcal::study
