/// Numbers along several dimensions, by their place along each: the one index arithmetic
/// for those that write a dataset and those that read it.
#pragma once

#include "study/stage.hpp"

#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

/// An index along each dimension, in their order.
using Indices = std::initializer_list<std::size_t>;

/// Of a dataset that outlives it.
class ArrayView {
  public:
    ArrayView() = default;
    explicit ArrayView(const Dataset& dataset)
        : shape_(dataset.shape), values_(dataset.values) {}

    /// NaN where there is no such place.
    double at(Indices indices) const;
    /// The numbers from a place on, along the dimensions that it does not name; empty
    /// where there is no such place.
    std::span<const double> part(Indices indices) const;
    /// How long a dimension is; 0 where there is none.
    std::size_t extent(std::size_t dimension) const {
        return dimension < shape_.size() ? shape_[dimension] : 0;
    }

  private:
    std::span<const std::size_t> shape_;
    std::span<const double> values_;
};

/// NaN until it is set.
struct Array {
    std::vector<std::string> dims;
    std::vector<std::size_t> shape = std::vector<std::size_t>(dims.size(), 0);
    std::vector<double> values{};

    /// \param extents  of the dimensions, in their order
    void resize(std::vector<std::size_t> extents);
    double at(Indices indices) const;
    /// Throws std::logic_error where there is no such place.
    void set(Indices indices, double value);
};

}  // namespace bemcal::study
