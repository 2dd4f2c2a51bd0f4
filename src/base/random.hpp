/// Counter-based random numbers: a stream belongs to an item, not to a rank or a thread.
///
/// Philox-4x32-10 (Salmon et al. 2011, SC11, doi:10.1145/2063384.2063405). The key is the
/// job's seed, the upper counter words are the stage and the item, so that any item's
/// numbers can be made anywhere, in any order.
#pragma once

#include <array>
#include <cstdint>

namespace bemcal {

/// A uniform random bit generator (usable with Boost.Random's and std's distributions).
class Stream {
  public:
    using result_type = std::uint32_t;

    Stream(std::uint64_t seed, std::uint32_t stage, std::uint64_t item);

    static constexpr result_type min() { return 0; }
    static constexpr result_type max() { return 0xffffffffU; }
    result_type operator()();

    double uniform();                      ///< in (0, 1), 53 bits
    std::uint32_t below(std::uint32_t n);  ///< integer in [0, n), unbiased

  private:
    void refill();

    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;
    std::array<std::uint32_t, 4> block_{};
    int used_ = 4;
};

/// The Philox-4x32-10 block function itself (for its known-answer test).
std::array<std::uint32_t, 4> philox_4x32_10(std::array<std::uint32_t, 4> counter,
                                            std::array<std::uint32_t, 2> key);

}  // namespace bemcal
