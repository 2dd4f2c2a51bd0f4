/// Arithmetic on a few points side by side, one a lane, with the same operations in every
/// lane whatever its neighbours hold. Internal to the residual model.
#pragma once

#include "base/nan.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace bemcal::stats::residual {

inline constexpr int width = 4;
using Lanes = Eigen::Array<double, width, 1>;

inline Lanes all(double value) {
    return Lanes::Constant(value);
}

/// Row `index` of scratch [rows x width].
inline Eigen::Map<Lanes> row(double* rows, std::size_t index) {
    return Eigen::Map<Lanes>(rows + index * width);
}
inline Lanes row(const double* rows, std::size_t index) {
    return Eigen::Map<const Lanes>(rows + index * width);
}

inline Lanes choose(const Eigen::Array<bool, width, 1>& where, const Lanes& yes,
                    const Lanes& no) {
    return where.select(yes, no);
}

/// Lanes [first, first + count) of a caller's array [rows x lanes]; where count < width,
/// the last is repeated.
struct Block {
    std::size_t first, count, lanes;

    Lanes load(const double* array, std::size_t index) const {
        const double* at = array + index * lanes + first;
        if (count == width) return Eigen::Map<const Lanes>(at);
        Lanes values;
        for (std::size_t k = 0; k < width; ++k)
            values[static_cast<Eigen::Index>(k)] = at[k < count ? k : count - 1];
        return values;
    }
    void store(double* array, std::size_t index, const Lanes& values) const {
        double* at = array + index * lanes + first;
        for (std::size_t k = 0; k < count; ++k)
            at[k] = values[static_cast<Eigen::Index>(k)];
    }
};

/// The logarithm of a long product for the price of one logarithm: exponents are counted
/// apart, so that nothing over- or underflows. NaN where a factor is not above 0 or not
/// finite.
class LogProduct {
  public:
    void times(const Lanes& factor) {
        product_ *= factor;
        least_ = least_.min(factor);
        most_ = most_.max(factor);
        for (int k = 0; k < width; ++k) {
            const auto bits = std::bit_cast<std::uint64_t>(product_[k]);
            exponents_[static_cast<std::size_t>(k)] += bits >> 52;
            product_[k] = std::bit_cast<double>((bits & mantissa) | one);
        }
        ++count_;
    }

    Lanes log() const {
        Lanes sum;
        for (int k = 0; k < width; ++k) {
            const auto exponent = static_cast<std::int64_t>(
                exponents_[static_cast<std::size_t>(k)] - 1023 * count_);
            sum[k] = static_cast<double>(exponent);
        }
        sum = sum * 0.6931471805599453 + product_.log();
        const auto is_sound = least_ > 0 && most_.isFinite();
        return choose(is_sound, sum, all(nan));
    }

  private:
    static constexpr std::uint64_t mantissa = 0x000fffffffffffffU;
    static constexpr std::uint64_t one = 0x3ff0000000000000U;
    Lanes product_ = all(1), least_ = all(1), most_ = all(1);
    std::array<std::uint64_t, width> exponents_{};
    std::uint64_t count_ = 0;
};

}  // namespace bemcal::stats::residual
