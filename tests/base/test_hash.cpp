#include "base/hash.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal {
namespace {

template <class... Parts>
std::string hash_of(const Parts&... parts) {
    Hasher hasher;
    (hasher.add(parts), ...);
    return hasher.hex();
}

// xxHash 0.8's specification: XXH3_128bits and XXH3_64bits of no bytes, seed 0.
TEST(Hash, EmptyInputGivesThePublishedDigests) {
    EXPECT_EQ(Hasher().hex(), "99aa06d3014798d86001c324468d497f");
    EXPECT_EQ(checksum64("", 0), 0x2d06800538d394c2ULL);
}

TEST(Hash, TextsAreSeparatedByTheirLength) {
    const std::string_view ab = "ab", c = "c", a = "a", bc = "bc";
    EXPECT_NE(hash_of(ab, c), hash_of(a, bc));
    EXPECT_EQ(hash_of(ab, c), hash_of(ab, c));
}

TEST(Hash, EveryNanCountsAsTheSameAndEveryOtherBitMatters) {
    const auto of = [](double value) {
        return hash_of(std::span<const double>(&value, 1));
    };
    EXPECT_EQ(of(std::nan("1")), of(-std::nan("2")));
    EXPECT_NE(of(0.1), of(std::nextafter(0.1, 1.0)));
    EXPECT_NE(of(0.0), of(-0.0));
}

TEST(Hash, ValuesBeyondOneBlockAreAllHashed) {
    std::vector<double> values(2000, 1.0);
    const std::string before = hash_of(std::span<const double>(values));
    for (const std::size_t k : {0U, 511U, 512U, 1023U, 1999U}) {
        std::vector<double> changed = values;
        changed[k] = 2.0;
        EXPECT_NE(hash_of(std::span<const double>(changed)), before) << k;
    }
}

}  // namespace
}  // namespace bemcal
