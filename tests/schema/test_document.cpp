/// TOML texts that a parser may stumble over: letters beyond ASCII in and outside quotes.
#include "base/error.hpp"
#include "schema/document.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

std::string message_of(const std::string& text) {
    try {
        schema::parse_document(text, "job.toml");
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

TEST(Document, KeepsLettersBeyondAsciiInQuotesAndComments) {
    const schema::Node node = schema::parse_document(
        "\xEF\xBB\xBF# B\xC3\xBCro\nname = \"B\xC3\xBCro\"\n", "job.toml");
    ASSERT_EQ(node.entries.size(), 1U);
    EXPECT_EQ(node.entries[0].node.text, "B\xC3\xBCro");
}

TEST(Document, RefusesLettersBeyondAsciiOutsideQuotesWithTheirLine) {
    EXPECT_NE(
        message_of("a = 1\nB\xC3\xBCro = 2\n").find("job.toml:2: a letter beyond ASCII"),
        std::string::npos);
}

/// The parser's table of blanks is undefined for this letter, which it meets after an
/// error.
TEST(Document, FindsWrongSyntaxBeforeALetterThatTheParserHasNoPlaceFor) {
    EXPECT_NE(message_of("--=2=\"\xC7\xA8"
                         "22@")
                  .find("expected TOML"),
              std::string::npos);
    EXPECT_NE(message_of("a = 1 \"\xC3\xA9\"").find("expected TOML"), std::string::npos);
}

}  // namespace
}  // namespace bemcal::job
