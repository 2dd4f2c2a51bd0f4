/// Counter-based random numbers: Philox-4x32-10 and its use as a stream.
/// Source: Salmon et al. 2011, section 3.3; whole numbers by Lemire 2019, algorithm 5.
/// A stream ends after 2^34 numbers. Distributions other than the uniform one are left to
/// their users.
#include "base/random.hpp"

#include "base/error.hpp"

namespace bemcal {
namespace {

using Counter = std::array<std::uint32_t, 4>;
using Key = std::array<std::uint32_t, 2>;

constexpr int n_rounds = 10;
constexpr std::uint64_t multiplier_0 = 0xD2511F53, multiplier_1 = 0xCD9E8D57;
constexpr std::uint32_t golden_ratio = 0x9E3779B9, sqrt_3_minus_1 = 0xBB67AE85;

Counter philox_round(const Counter& c, const Key& key) {
    const std::uint64_t product_0 = multiplier_0 * c[0];
    const std::uint64_t product_1 = multiplier_1 * c[2];
    return {static_cast<std::uint32_t>(product_1 >> 32) ^ c[1] ^ key[0],
            static_cast<std::uint32_t>(product_1),
            static_cast<std::uint32_t>(product_0 >> 32) ^ c[3] ^ key[1],
            static_cast<std::uint32_t>(product_0)};
}

}  // namespace

std::array<std::uint32_t, 4> philox_4x32_10(std::array<std::uint32_t, 4> counter,
                                            std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < n_rounds; ++round) {
        counter = philox_round(counter, key);
        key[0] += golden_ratio;
        key[1] += sqrt_3_minus_1;
    }
    return counter;
}

Stream::Stream(std::uint64_t seed, std::uint32_t stage, std::uint64_t item)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, stage, static_cast<std::uint32_t>(item),
               static_cast<std::uint32_t>(item >> 32)} {}

void Stream::refill() {
    block_ = philox_4x32_10(counter_, key_);
    ++counter_[0];
    require(counter_[0] != 0, "a random stream is used up after 2^34 numbers");
    used_ = 0;
}

Stream::result_type Stream::operator()() {
    if (used_ == 4) refill();
    return block_[static_cast<std::size_t>(used_++)];
}

double Stream::uniform() {
    const std::uint64_t high = (*this)() >> 6;  // 26 bits
    const std::uint64_t low = (*this)() >> 6;   // 26 bits
    return (static_cast<double>((high << 26) | low) + 0.5) * 0x1p-52;
}

/// Lemire 2019, "Fast random integer generation in an interval", algorithm 5.
std::uint32_t Stream::below(std::uint32_t n) {
    require(n > 0, "Stream::below needs n > 0");
    std::uint64_t product = std::uint64_t{(*this)()} * n;
    if (static_cast<std::uint32_t>(product) < n) {
        const std::uint32_t threshold = (0U - n) % n;
        while (static_cast<std::uint32_t>(product) < threshold)
            product = std::uint64_t{(*this)()} * n;
    }
    return static_cast<std::uint32_t>(product >> 32);
}

}  // namespace bemcal
