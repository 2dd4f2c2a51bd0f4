#include "loop/unusual_end.hpp"

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;

namespace {

/// Mean 2 K, standard deviation 0.5 K, from 0 to 4 K: ends at 4 sd to each side.
study::FitUnknown set_back() {
    return {"set_back", "K", 2, 0.5, 0, 4, true};
}

}  // namespace

TEST(UnusualEnd, IsAtAnEndOfTheRange) {
    EXPECT_EQ(unusual_end(set_back(), -4, false), "at the lower end of its range: 0 K");
    EXPECT_EQ(unusual_end(set_back(), 4, false), "at the upper end of its range: 4 K");
    study::FitUnknown near = set_back();
    near.most = 2.5;  // 1 sd
    EXPECT_EQ(unusual_end(near, 1, false), "at the upper end of its range: 2.5 K");
    EXPECT_EQ(unusual_end(near, 0.999, false), "");
}

TEST(UnusualEnd, IsNoneWhereARefinementIsLeftOut) {
    EXPECT_EQ(unusual_end(set_back(), -4, true), "");
    EXPECT_EQ(unusual_end(set_back(), 4, true), "at the upper end of its range: 4 K");
}

TEST(UnusualEnd, IsMoreThanThreeDeviationsFromAPrior) {
    EXPECT_EQ(unusual_end(set_back(), 3, false), "");
    EXPECT_EQ(unusual_end(set_back(), -3, false), "");
    EXPECT_NE(unusual_end(set_back(), 3.01, false), "");
    EXPECT_EQ(unusual_end(set_back(), 3.1, false), "3.1 prior sd from its mean: 3.55 K");
    EXPECT_EQ(unusual_end(set_back(), -3.1, false), "3.1 prior sd from its mean: 0.45 K");
    study::FitUnknown anything = set_back();
    anything.has_prior = false;
    EXPECT_EQ(unusual_end(anything, 3.1, false), "");
}

TEST(UnusualEnd, AShareHasNoUnit) {
    study::FitUnknown share = set_back();
    share.unit = "-";
    EXPECT_EQ(unusual_end(share, 4, false), "at the upper end of its range: 4");
    share.unit = "";
    EXPECT_EQ(unusual_end(share, 4, false), "at the upper end of its range: 4");
}
