/// Decisions taken from a fuzzer's bytes, one after the other; 0 beyond their end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

namespace bemcal::fuzz {

class Choices {
  public:
    explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool is_over() const { return at_ >= bytes_.size(); }
    std::size_t byte() { return is_over() ? 0 : bytes_[at_++]; }
    std::size_t number() {
        const std::size_t high = byte();
        return 256 * high + byte();
    }
    std::size_t below(std::size_t n) { return n == 0 ? 0 : number() % n; }
    template <class Range>
    auto& one_of(Range& range) {
        return *(std::begin(range) +
                 static_cast<std::ptrdiff_t>(below(std::size(range))));
    }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

}  // namespace bemcal::fuzz
