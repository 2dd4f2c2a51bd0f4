/// Letters of any size as one.
#include "base/lower_case.hpp"

#include <gtest/gtest.h>

namespace bemcal {
namespace {

TEST(LowerCase, IsOfAsciiLettersAlone) {
    EXPECT_EQ(lower_case("Gas METER 1_Z"), "gas meter 1_z");
    EXPECT_EQ(lower_case("B\xC3\x9CRO"), "b\xC3\x9Cro");  // an umlaut stays
    EXPECT_EQ(lower_case(""), "");
}

}  // namespace
}  // namespace bemcal
