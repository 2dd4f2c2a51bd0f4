#include "job/content_hash.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

std::string hash_of(const char* text) {
    return content_hash(text, "stock.toml");
}

const char* const plain = "seed = 1\n[stock]\ntable = \"a.csv\"\nwindow_days = 300\n";

TEST(ContentHash, CommentsLayoutAndOrderSayNothing) {
    EXPECT_EQ(
        hash_of(plain),
        hash_of("# of a district\nstock = {window_days = 300.0, table = \"a.csv\"}\n"
                "seed = 1  # any\n"));
}

TEST(ContentHash, NorDoesHowANightRuns) {
    EXPECT_EQ(hash_of(plain),
              hash_of("seed = 1\n[output]\nmax_failed_share = 0.5\n[stock]\n"
                      "table = \"b.csv\"\nwindow_days = 300\nhours = 8\n"
                      "budget = 1000\nkeep_results = true\n"));
}

TEST(ContentHash, AllElseDoes) {
    EXPECT_NE(hash_of(plain),
              hash_of("seed = 2\n[stock]\ntable = \"a.csv\"\nwindow_days = 300\n"));
    EXPECT_NE(hash_of(plain),
              hash_of("seed = 1\n[stock]\ntable = \"a.csv\"\nwindow_days = 301\n"));
    EXPECT_NE(hash_of("a = [1, 2]"), hash_of("a = [2, 1]"));
    EXPECT_NE(hash_of("[[a]]\nx = 1\n[[a]]\ny = 2"), hash_of("[[a]]\nx = 1\ny = 2"));
    EXPECT_NE(hash_of(plain),
              hash_of((std::string(plain) + "[output]\nhourly = [\"gas\"]").c_str()));
    EXPECT_NE(hash_of("a = \"1\""), hash_of("a = 1"));
}

}  // namespace
}  // namespace bemcal::job
