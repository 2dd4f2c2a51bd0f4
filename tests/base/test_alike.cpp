#include "base/alike.hpp"

#include <gtest/gtest.h>

namespace bemcal {
namespace {

/// Things of one kind are alike; counts what is asked.
struct Kinds {
    std::vector<int> kinds;
    std::size_t n_asked = 0;

    AlikeGroups grouped() {
        AlikeGroups groups(kinds.size());
        for (std::size_t k = 0; k < kinds.size(); ++k)
            groups.add(k, [&](std::size_t earlier, std::size_t later) {
                EXPECT_LT(earlier, later);
                ++n_asked;
                return kinds[earlier] == kinds[later];
            });
        return groups;
    }
};

TEST(AlikeGroups, OfASmallGroupEveryPairIsLookedAt) {
    Kinds kinds{std::vector<int>(AlikeGroups::most_listed, 7)};
    const AlikeGroups groups = kinds.grouped();
    EXPECT_EQ(kinds.n_asked, 45U);
    EXPECT_FALSE(groups.is_large(3));
    EXPECT_TRUE(groups.large_groups().empty());
}

TEST(AlikeGroups, OfALargeOneAFewForEachMember) {
    Kinds kinds{std::vector<int>(1000, 7)};
    const AlikeGroups groups = kinds.grouped();
    EXPECT_LE(kinds.n_asked, 1100U);
    ASSERT_EQ(groups.large_groups().size(), 1U);
    EXPECT_EQ(groups.large_groups()[0].size(), 1000U);
}

TEST(AlikeGroups, GroupsAreWhatTheThingsAre) {
    Kinds kinds;
    for (int k = 0; k < 300; ++k) kinds.kinds.push_back(k % 20 < 10 ? k % 20 : 100 + k);
    const AlikeGroups groups = kinds.grouped();
    ASSERT_EQ(groups.large_groups().size(), 10U);
    for (std::size_t g = 0; g < 10; ++g) {
        EXPECT_EQ(groups.large_groups()[g].size(), 15U);
        EXPECT_EQ(groups.large_groups()[g][1], 20 + g);
    }
    EXPECT_EQ(groups.first_of(299), 299U);
}

TEST(AlikeGroups, WhatWasJoinedBeforeCounts) {
    AlikeGroups groups(30);
    for (std::size_t k = 0; k < 12; ++k) groups.join(29 - k, 28 - k);
    EXPECT_TRUE(groups.is_large(20));
    EXPECT_EQ(groups.first_of(29), 17U);
    std::size_t n_asked = 0;
    for (std::size_t k = 0; k < 30; ++k)
        groups.add(k, [&](std::size_t earlier, std::size_t) {
            n_asked += earlier >= 17;
            return false;
        });
    EXPECT_EQ(n_asked, 0U);
}

}  // namespace
}  // namespace bemcal
