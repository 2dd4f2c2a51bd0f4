#include "base/apart.hpp"

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace bemcal {
namespace {

std::string answer_of(const Apart& apart) {
    std::string text(100, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), apart.answer()));
    return text;
}

TEST(Apart, ItsAnswerComesThroughThePipe) {
    int ours = 1;
    Apart apart(
        [&](std::FILE* out) {
            ours = 2;
            std::fputs("done", out);
        },
        {});
    EXPECT_EQ(answer_of(apart), "done");
    EXPECT_EQ(apart.ending(), "");
    EXPECT_EQ(apart.ending(), "");
    EXPECT_EQ(ours, 1);
}

TEST(Apart, ACrashIsToldInWords) {
    Apart fault([](std::FILE*) { ::raise(SIGSEGV); }, {});
    EXPECT_EQ(answer_of(fault), "");
    EXPECT_EQ(fault.ending(), "Segmentation fault");
    Apart stopped([](std::FILE*) { std::abort(); }, {});
    EXPECT_EQ(stopped.ending(), "Aborted");
    Apart thrown([](std::FILE*) { throw std::runtime_error("no"); }, {});
    EXPECT_EQ(thrown.ending(), "it failed");
}

TEST(Apart, ALoopWithoutEndComesToOne) {
    Apart apart(
        [](std::FILE*) {
            for (const volatile bool goes_on = true; goes_on;) continue;
        },
        {1, std::size_t{1} << 30});
    EXPECT_EQ(answer_of(apart), "");
    EXPECT_EQ(apart.ending(), "it came to no end");
}

TEST(Apart, TooMuchMemoryIsRefused) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer's allocator ends the process itself";
#endif
    Apart apart(
        [](std::FILE*) {
            std::vector<std::vector<char>> all;
            while (all.size() < 4096) all.emplace_back(std::size_t{1} << 20, 'x');
        },
        {10, std::size_t{1} << 28});
    EXPECT_EQ(apart.ending(), "there is too little memory for it");
}

TEST(Apart, OneThatNobodyWaitsForGoes) {
    const Apart apart([](std::FILE*) { ::pause(); }, {});
    SUCCEED();
}

TEST(Apart, OneWhoseAnswerIsNotReadGoes) {
    Apart apart(
        [](std::FILE* out) {
            for (int k = 0; k < 1000000; ++k) std::fputs("more than a pipe holds", out);
        },
        {});
    EXPECT_EQ(apart.ending(), "Broken pipe");
}

}  // namespace
}  // namespace bemcal
