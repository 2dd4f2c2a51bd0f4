/// A 128-bit content hash (XXH3): for results, the identity of input files, log records.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace bemcal {

/// Hashes whatever is added, in the order of the calls.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    void add(const void* data, std::size_t bytes);
    void add(std::string_view text);  ///< length first, so that "ab","c" != "a","bc"
    void add(std::span<const double> values);  ///< bits; all NaN are the same
    std::string hex() const;  ///< 32 hexadecimal digits of all added so far

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// 64-bit checksum of one record.
unsigned long long checksum64(const void* data, std::size_t bytes);

}  // namespace bemcal
