/// Doubles [columns x lanes] on a cache line's boundary: what the kernels read and write.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

namespace bemcal {

class LaneArray {
  public:
    LaneArray() = default;
    LaneArray(std::size_t columns, int lanes)
        : lanes_(static_cast<std::size_t>(lanes)),
          size_(columns * lanes_),
          values_(new(std::align_val_t{64}) double[std::max<std::size_t>(size_, 1)]()) {}

    double* data() { return values_.get(); }
    const double* data() const { return values_.get(); }
    double* column(std::size_t index) { return data() + index * lanes_; }
    double at(std::size_t column, int lane) const {
        return values_[column * lanes_ + static_cast<std::size_t>(lane)];
    }
    std::size_t columns() const { return size_ / lanes_; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    void clear() { std::fill_n(data(), size_, 0.0); }
    void clear_lane(int lane) { fill_lane(lane, 0); }
    void fill_lane(int lane, double value) {
        for (std::size_t k = static_cast<std::size_t>(lane); k < size_; k += lanes_)
            values_[k] = value;
    }
    void copy_lane(int from, int to) {
        for (std::size_t k = 0; k < size_; k += lanes_)
            values_[k + static_cast<std::size_t>(to)] =
                values_[k + static_cast<std::size_t>(from)];
    }

  private:
    struct Free {
        void operator()(double* values) const {
            ::operator delete[](values, std::align_val_t{64});
        }
    };
    std::size_t lanes_ = 0, size_ = 0;
    std::unique_ptr<double[], Free> values_;
};

}  // namespace bemcal
