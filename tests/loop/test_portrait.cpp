#include "loop/portrait.hpp"

#include <gtest/gtest.h>

using namespace bemcal::loop;

// What noise shows is 1.
TEST(LoopPortrait, APatternIsOverWhereHalfOfItsAlarmIsLeft) {
    EXPECT_TRUE(is_over(4, 1.99));
    EXPECT_FALSE(is_over(4, 2.01));
    EXPECT_TRUE(is_over(1.5, 1));
    EXPECT_FALSE(is_over(1.5, 1.01));
}
