#include "base/terminal.hpp"

#include <gtest/gtest.h>

namespace bemcal {
namespace {

TEST(Terminal, WordsOfAnyLanguageStayAsTheyAre) {
    for (const char* text : {"office", "Bürohaus 3 m²", "学校", "a\tb\nc", "café 🏠"})
        EXPECT_EQ(printable(text), text);
}

TEST(Terminal, EscapeSequencesAreShownNotSent) {
    EXPECT_EQ(printable("x\x1b[31mred"), "x\\x1b[31mred");
    EXPECT_EQ(printable("a\rb\x07\x7f"), "a\\x0db\\x07\\x7f");
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "\\x9b31m")
        << "the one-byte CSI of C1";
    EXPECT_EQ(printable("a\xe2\x80\xae"
                        "b"),
              "a\\u202eb")
        << "right to left";
}

TEST(Terminal, BytesThatAreNoUtf8AreShown) {
    EXPECT_EQ(printable("\x9b"
                        "31m"),
              "\\x9b31m");
    EXPECT_EQ(printable("caf\xe9"), "caf\\xe9");
    EXPECT_EQ(printable("\xe2\x80"), "\\xe2\\x80") << "cut off";
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "overlong";
    EXPECT_EQ(printable("\xc1\x9b"), "\\xc1\\x9b");
    EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair";
}

TEST(Terminal, OneLineHasNoLineEnds) {
    EXPECT_EQ(in_one_line("a\n\tb\r"), "a\\n\\tb\\x0d");
}

TEST(Terminal, OutputThatCannotBeWrittenIsRemembered) {
    EXPECT_FALSE(is_output_lost());
    std::FILE* full = std::fopen("/dev/full", "w");
    ASSERT_NE(full, nullptr);
    print(full, "a line\n");
    EXPECT_TRUE(is_output_lost());
    std::fclose(full);
}

}  // namespace
}  // namespace bemcal
