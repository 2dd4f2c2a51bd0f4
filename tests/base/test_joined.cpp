/// Words of a table in one text, made when the program is compiled.
#include "base/joined.hpp"

#include <gtest/gtest.h>

namespace bemcal {
namespace {

constexpr std::array<const char*, 3> three = {"gas", "", "oil"};
constexpr std::array<const char*, 1> one = {"gas"};

TEST(Joined, PutsABarBetweenWords) {
    static_assert(std::string_view(joined<three>.data()) == "gas||oil");
    EXPECT_STREQ(joined<three>.data(), "gas||oil");
    EXPECT_STREQ(joined<one>.data(), "gas");
}

}  // namespace
}  // namespace bemcal
