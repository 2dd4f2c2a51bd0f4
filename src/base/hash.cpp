/// Content hashes and checksums by XXH3. All NaN count as the same number; other doubles
/// count by their bits.
/// Source: XXH3 (Y. Collet), from the xxHash header, which this file alone includes.
/// It finds accidents, not forgery: XXH3 is not cryptographic.
#include "base/hash.hpp"

#include "base/nan.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

namespace bemcal {

struct Hasher::State {
    XXH3_state_t xxh;
};

Hasher::Hasher() : state_(std::make_unique<State>()) {
    XXH3_128bits_reset(&state_->xxh);
}

Hasher::~Hasher() = default;

void Hasher::add(const void* data, std::size_t bytes) {
    if (bytes > 0) XXH3_128bits_update(&state_->xxh, data, bytes);
}

void Hasher::add(std::string_view text) {
    const std::uint64_t length = text.size();
    add(&length, sizeof length);
    add(text.data(), text.size());
}

void Hasher::add(std::span<const double> values) {
    const std::uint64_t length = values.size();
    add(&length, sizeof length);
    constexpr std::size_t block = 512;
    double canonical[block];
    for (std::size_t first = 0; first < values.size(); first += block) {
        const auto part = values.subspan(first, std::min(block, values.size() - first));
        for (std::size_t k = 0; k < part.size(); ++k)
            canonical[k] = std::isnan(part[k]) ? nan : part[k];
        add(canonical, part.size() * sizeof(double));
    }
}

std::string Hasher::hex() const {
    const XXH128_hash_t digest = XXH3_128bits_digest(&state_->xxh);
    return fmt::format("{:016x}{:016x}", digest.high64, digest.low64);
}

unsigned long long checksum64(const void* data, std::size_t bytes) {
    return XXH3_64bits(data, bytes);
}

}  // namespace bemcal
