/// Counter-based random numbers: Random123's Philox-4x32-10 as a stream.
/// Source: Salmon et al. 2011, section 3.3; whole numbers by Lemire 2019, algorithm 5.
/// A stream ends after 2^34 numbers. Distributions other than the uniform one are left to
/// their users.
#include "base/random.hpp"

#include "base/error.hpp"

#include <Random123/philox.h>

namespace bemcal {

std::array<std::uint32_t, 4> philox_4x32_10(std::array<std::uint32_t, 4> counter,
                                            std::array<std::uint32_t, 2> key) {
    using Philox = r123::Philox4x32_R<10>;
    const Philox::ctr_type block =
        Philox()({{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
    return {block[0], block[1], block[2], block[3]};
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
