/// Broken texts by the hundred, from fixed seeds: readers answer or throw UserError,
/// never else. The fuzzers of tests/fuzz go on where this ends.
#include "fuzz/targets.hpp"

#include <random>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

/// A few bytes changed, removed, repeated or swapped for a piece from elsewhere in the
/// text.
std::string mutated(std::string text, std::mt19937& random) {
    const auto below = [&](std::size_t n) {
        return random() % std::max<std::size_t>(n, 1);
    };
    static const std::string pieces[] = {"nan", "-1", "1e308", "inf", "\"", "[",
                                         "]",   "{",  "\n",    "=",   ".",  "[[",
                                         ",",   "é",  "0",     "9",   "-",  "#"};
    for (std::size_t n = 1 + below(4); n > 0; --n) {
        const std::size_t at = below(text.size()), length = below(30);
        switch (below(5)) {
            case 0:
                text.insert(at, pieces[below(std::size(pieces))]);
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(below(text.size()), length));
                break;
            case 3:
                if (!text.empty()) text[at] = static_cast<char>(below(256));
                break;
            default:
                text.replace(at, length, pieces[below(std::size(pieces))]);
        }
    }
    return text;
}

template <class Try>
void try_many(const std::string& seed_text, int n, Try attempt) {
    std::mt19937 random(2021);
    for (int i = 0; i < n; ++i) {
        const std::string text = mutated(seed_text, random);
        try {
            attempt(text);
        } catch (const std::exception& error) {
            FAIL() << error.what() << " from\n" << text.substr(0, 4000);
        }
    }
}

TEST(Mutations, OfJobsEndInAnAnswerOrAUserError) {
    try_many(small_office_text(), 300, [](const std::string& text) { try_job(text); });
}

TEST(Mutations, OfStockTablesEndInAnAnswerOrAUserError) {
    try_many(small_table(), 200, [](const std::string& text) { try_stock(text); });
}

TEST(Mutations, OfCsvFilesEndInAnAnswerOrAUserError) {
    try_many(small_readings(48), 600, [](const std::string& text) { try_csv(text); });
}

TEST(Mutations, OfFilesOfAnyKindEndInAnAnswerOrAUserError) {
    for (const std::string& text :
         {std::string("PK\x03\x04") + std::string(26, '\x08') + "a file's name",
          std::string("\xFF\xFEt\0i\0m\0e\0", 10), std::string("Z\xE4hler\n\x93 5\n")})
        try_many(text, 300, [](const std::string& bytes) { try_data(bytes); });
}

TEST(Mutations, OfEpwFilesEndInAnAnswerOrAUserError) {
    try_many(small_epw(), 600, [](const std::string& text) { try_epw(text); });
}

TEST(Mutations, OfGzipEndInAnAnswerOrAUserError) {
    // gzip -9 of "a,b\n1,2\n"
    const std::string packed(
        "\x1f\x8b\x08\x00\x00\x00\x00\x00\x02\x03\x4b\xd4\x49\xe2\x32\xd4"
        "\x31\xe2\x02\x00\x3e\x3e\x0a\x33\x08\x00\x00\x00",
        28);
    try_many(packed, 600, [](const std::string& bytes) { try_gzip(bytes); });
}

}  // namespace
}  // namespace bemcal::job
