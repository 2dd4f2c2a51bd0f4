#include "run/part_folder.hpp"
#include "run/progress.hpp"
#include "run/threads.hpp"

#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

TEST(Threads, ARankAloneTakesAllItsCores) {
    EXPECT_EQ(default_threads({{"a", {0, 1, 2, 3}}}, 0), 4);
}

TEST(Threads, BoundRanksTakeTheirOwnCores) {
    const std::vector<Placement> ranks{{"a", {0, 1}}, {"a", {2, 3, 4}}, {"b", {0}}};
    EXPECT_EQ(default_threads(ranks, 0), 2);
    EXPECT_EQ(default_threads(ranks, 1), 3);
    EXPECT_EQ(default_threads(ranks, 2), 1);
}

TEST(Threads, UnboundRanksOfAHostShareItsCores) {
    const std::vector<int> cores{0, 1, 2, 3, 4, 5, 6, 7};
    const std::vector<Placement> ranks{
        {"a", cores}, {"a", cores}, {"a", cores}, {"b", cores}};
    EXPECT_EQ(default_threads(ranks, 0), 2);
    EXPECT_EQ(default_threads(ranks, 3), 8);
}

TEST(Threads, WarnsWhereThreadsShareACoreAndSaysWhatToDo) {
    const std::vector<Placement> ranks{{"a", {0}}, {"a", {1}}};
    EXPECT_TRUE(crowded_hosts(ranks, {1, 1}).empty());
    const auto warnings = crowded_hosts(ranks, {2, 1});
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("slot:PE="), std::string::npos);
}

TEST(Threads, WarnsWhereRanksAreBoundToOneCoreThoughOthersAreFree) {
    const std::vector<Placement> ranks{
        {"a", {0}}, {"a", {1, 2, 3}}, {"a", {0}}, {"b", {0}}};
    const auto warnings = crowded_hosts(ranks, {1, 1, 1, 1});
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_TRUE(warnings[0].starts_with(
        "a: 2 ranks with 2 compute threads may use only 1 core (0), so that threads "
        "share cores"))
        << warnings[0];
    EXPECT_EQ(crowded_hosts(ranks, {1, 3, 1, 2}).size(), 2U);
    EXPECT_TRUE(
        crowded_hosts({{"a", {0, 1, 2}}, {"a", {1, 2}}, {"a", {2}}}, {1, 1, 1}).empty());
}

TEST(Threads, ThisProcessHasACore) {
    EXPECT_FALSE(placement().cores.empty());
}

TEST(Progress, SaysWhatIsDoneFailedAndLeft) {
    const Progress progress{30, 10, 40, 7, 5.0};
    EXPECT_EQ(progress_text({"office/screening", 4000}, progress, 0),
              "office/screening: 30 of 40 items, 2993 ok, 7 failed, 400/s, 0:03 left");
    EXPECT_EQ(format_duration(3 * 3600 + 125), "3:02:05");
}

TEST(Identity, TheFirstDifferenceIsNamed) {
    const Identity before{
        {"version", "1"}, {"file a.toml", "12"}, {"stage x", "3 items"}};
    EXPECT_EQ(difference(before, before), "");
    EXPECT_EQ(difference(before, {{"version", "2"}, {"file a.toml", "12"}}),
              "it was begun by version 1, this is version 2");
    EXPECT_EQ(
        difference(before,
                   {{"version", "1"}, {"file a.toml", "13"}, {"stage x", "3 items"}}),
        "a.toml has changed since");
    EXPECT_EQ(difference(before, {{"version", "1"}, {"file a.toml", "12"}}),
              "stage x was part of it and is no longer");
    EXPECT_NE(difference(before, {{"version", "1"},
                                  {"file a.toml", "12"},
                                  {"stage x", "3 items"},
                                  {"stage y", "1 items"}}),
              "");
}

}  // namespace
}  // namespace bemcal::run
