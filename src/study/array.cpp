/// Finds numbers of several dimensions by their place along each.
/// Follows from row-major order: the last dimension is the nearest.
/// Names of dimensions are not compared: a place has them in the dataset's order.
#include "study/array.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"

#include <functional>
#include <numeric>

namespace bemcal::study {
namespace {

/// [begin, end) of the values.
struct Range {
    std::size_t begin = 0, end = 0;
};

/// Empty where there is no such place, or too many indices.
Range range_of(std::span<const std::size_t> shape, Indices indices) {
    if (indices.size() > shape.size()) return {};
    std::size_t at = 0, dimension = 0;
    for (const std::size_t index : indices) {
        if (index >= shape[dimension]) return {};
        at = at * shape[dimension++] + index;
    }
    const std::size_t size =
        std::accumulate(shape.begin() + static_cast<std::ptrdiff_t>(dimension),
                        shape.end(), std::size_t{1}, std::multiplies());
    return {at * size, (at + 1) * size};
}

}  // namespace

std::span<const double> ArrayView::part(Indices indices) const {
    const Range range = range_of(shape_, indices);
    if (range.end > values_.size()) return {};
    return values_.subspan(range.begin, range.end - range.begin);
}

double ArrayView::at(Indices indices) const {
    const auto one = part(indices);
    return one.size() == 1 ? one[0] : nan;
}

void Array::resize(std::vector<std::size_t> extents) {
    require(extents.size() == dims.size(), "an array has an extent for each dimension");
    shape = std::move(extents);
    values.assign(
        std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies()),
        nan);
}

double Array::at(Indices indices) const {
    const Range range = range_of(shape, indices);
    return range.end - range.begin == 1 && range.end <= values.size()
               ? values[range.begin]
               : nan;
}

void Array::set(Indices indices, double value) {
    const Range range = range_of(shape, indices);
    require(range.end - range.begin == 1, "an array has no such place");
    values[range.begin] = value;
}

}  // namespace bemcal::study
