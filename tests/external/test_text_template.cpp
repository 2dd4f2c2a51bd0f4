#include "base/error.hpp"
#include "external/text_template.hpp"

#include <gtest/gtest.h>

namespace bemcal::external {
namespace {

std::string filled(const std::string& text, std::vector<double> values) {
    return TextTemplate(text, "house.in", {"u", "air_change"}).filled(values);
}

TEST(TextTemplate, EveryPlaceGetsItsNumber) {
    EXPECT_EQ(filled("U @u@,\n n = @air_change@; again @u@", {0.1, 20}),
              "U 0.1,\n n = 20; again 0.1");
}

TEST(TextTemplate, NumbersHaveTheDigitsThatGiveThemBack) {
    EXPECT_EQ(filled("@u@ @air_change@", {0.1 + 0.2, 1e-7}), "0.30000000000000004 1e-07");
}

TEST(TextTemplate, NamesBehindNumbersAreTexts) {
    const TextTemplate text("u @u@\n@air@\nend @u@", "house.in", {"u", "air"});
    EXPECT_EQ(text.filled(std::vector{0.5}, std::vector<std::string>{"1\n2"}),
              "u 0.5\n1\n2\nend 0.5");
}

TEST(TextTemplate, AnotherAtIsItself) {
    for (const char* text :
         {"me@example.org", "@", "@@", "@ u@", "a@u", "@u b@", "@5@", "x@@", ""})
        EXPECT_EQ(filled(text, {1, 2}), text);
    EXPECT_EQ(filled("@@u@@", {1, 2}), "@1@");
    EXPECT_EQ(filled("me@u@u@", {1, 2}), "me1u@");
}

TEST(TextTemplate, SaysWhichAreUsed) {
    const TextTemplate text("@u@", "house.in", {"u", "air_change"});
    EXPECT_TRUE(text.uses(0));
    EXPECT_FALSE(text.uses(1));
}

TEST(TextTemplate, AnUnknownNameIsAnErrorWithItsLine) {
    try {
        filled("one\ntwo @u@\n @colour@", {1, 2});
        FAIL();
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::config);
        EXPECT_STREQ(
            error.what(),
            "house.in:3: @colour@ is no parameter; expected one of u, air_change");
    }
}

}  // namespace
}  // namespace bemcal::external
