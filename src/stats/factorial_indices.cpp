/// Total-order Sobol indices from a full grid. With hat functions on each axis, E[f^2] is
/// a quadratic form of mass matrices, E over one argument a weighted sum along its axis.
/// Source: Saltelli et al. 2010, eq. 4; the integrals are exact. What the function does
/// between the points is not seen; first-order indices are left out.
#include "stats/factorial_indices.hpp"

#include "base/nan.hpp"

#include <cmath>
#include <stdexcept>

namespace bemcal::stats {
namespace {

using Axis = std::vector<double>;

/// An array of any number of dimensions, seen along one of them.
struct Along {
    std::size_t outer, size, inner;
};

Along along(const std::vector<Axis>& axes, std::size_t axis) {
    Along view{1, axes[axis].size(), 1};
    for (std::size_t k = 0; k < axis; ++k) view.outer *= axes[k].size();
    for (std::size_t k = axis + 1; k < axes.size(); ++k) view.inner *= axes[k].size();
    return view;
}

/// Share of the axis's range between its values k and k + 1; 0 outside.
double gap(const Axis& axis, std::size_t k) {
    return k + 1 < axis.size() ? (axis[k + 1] - axis[k]) / (axis.back() - axis[0]) : 0;
}

/// Means of the hat functions; sum 1.
std::vector<double> weights_of(const Axis& axis) {
    if (axis.size() == 1) return {1};
    std::vector<double> weights(axis.size(), 0);
    for (std::size_t k = 0; k + 1 < axis.size(); ++k) {
        weights[k] += gap(axis, k) / 2;
        weights[k + 1] += gap(axis, k) / 2;
    }
    return weights;
}

/// The mean over an argument, in place of its values. \return without that axis
std::vector<double> mean_along(std::vector<Axis>& axes, std::size_t axis,
                               const std::vector<double>& values) {
    const auto [outer, size, inner] = along(axes, axis);
    const std::vector<double> weights = weights_of(axes[axis]);
    std::vector<double> means(outer * inner, 0);
    for (std::size_t o = 0; o < outer; ++o)
        for (std::size_t k = 0; k < size; ++k)
            for (std::size_t i = 0; i < inner; ++i)
                means[o * inner + i] += weights[k] * values[(o * size + k) * inner + i];
    axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(axis));
    return means;
}

/// The axis's mass matrix (means of products of hats: tridiagonal) applied along it.
std::vector<double> mass_along(const std::vector<Axis>& axes, std::size_t axis,
                               const std::vector<double>& values) {
    const auto [outer, size, inner] = along(axes, axis);
    if (size == 1) return values;
    std::vector<double> result(values.size(), 0);
    for (std::size_t o = 0; o < outer; ++o)
        for (std::size_t k = 0; k + 1 < size; ++k) {
            const double sixth = gap(axes[axis], k) / 6;
            const std::size_t low = (o * size + k) * inner, high = low + inner;
            for (std::size_t i = 0; i < inner; ++i) {
                const double a = values[low + i], b = values[high + i];
                result[low + i] += sixth * (2 * a + b);
                result[high + i] += sixth * (a + 2 * b);
            }
        }
    return result;
}

double mean_square(const std::vector<Axis>& axes, const std::vector<double>& values) {
    std::vector<double> weighted = values;
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
        weighted = mass_along(axes, axis, weighted);
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += values[k] * weighted[k];
    return sum;
}

double mean_of(std::vector<Axis> axes, std::vector<double> values) {
    while (!axes.empty()) values = mean_along(axes, 0, values);
    return values.at(0);
}

void check(const std::vector<Axis>& axes, std::size_t n) {
    std::size_t product = 1;
    for (const Axis& axis : axes) product *= axis.size();
    if (product != n || n == 0)
        throw std::invalid_argument("outputs do not fit the grid's size");
}

}  // namespace

std::vector<double> total_order_on_grid(const std::vector<std::vector<double>>& axes,
                                        std::span<const double> outputs) {
    check(axes, outputs.size());
    std::vector<double> centred(outputs.begin(), outputs.end());
    const double mean = mean_of(axes, centred);
    for (double& value : centred) value -= mean;
    const double variance = mean_square(axes, centred);
    // A function that does not vary leaves no more than its rounding.
    const bool varies = variance > 1e-24 * mean * mean;
    std::vector<double> indices(axes.size(), nan);
    for (std::size_t i = 0; i < axes.size() && varies; ++i) {
        std::vector<Axis> others = axes;
        const std::vector<double> means = mean_along(others, i, centred);
        indices[i] = 1 - mean_square(others, means) / variance;
    }
    return indices;
}

}  // namespace bemcal::stats
