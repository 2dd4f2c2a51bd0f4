/// The k points nearest to a reference, plain or with density avoidance: points in
/// crowded places tag their nearest neighbour, and the k nearest untagged ones are taken.
/// Source: paper 3 (its text, not its Figure 2); default radius and threshold are our
/// own. Left out: the vote of k-NN, the Parzen window, scaling of coordinates.
#include "stats/nearest.hpp"

#include "stats/point_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <ranges>
#include <stdexcept>

namespace bemcal::stats {
namespace {

void check(const Matrix& points, std::span<const double> reference) {
    if (points.cols != reference.size())
        throw std::invalid_argument("points and reference are of different dimensions");
    const auto is_finite = [](double x) { return std::isfinite(x); };
    if (!std::ranges::all_of(points.values, is_finite) ||
        !std::ranges::all_of(reference, is_finite))
        throw std::invalid_argument("a coordinate is no finite number");
}

/// Squared, of every point to the reference.
std::vector<double> distances(const Matrix& points, std::span<const double> reference) {
    std::vector<double> found(points.rows);
    for (std::size_t r = 0; r < points.rows; ++r)
        found[r] = squared_distance(points.row(r), reference);
    return found;
}

/// The first `n` indices by rising key, ties by index.
std::vector<std::size_t> order_of(const std::vector<double>& keys, std::size_t n) {
    std::vector<std::size_t> order(keys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto before = [&](std::size_t a, std::size_t b) {
        return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
    };
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(n);
    std::ranges::nth_element(order, middle, before);
    std::ranges::sort(order.begin(), middle, before);
    order.resize(n);
    return order;
}

/// Share of the points per volume.
double density(std::size_t count, std::size_t n, double volume) {
    return static_cast<double>(count) / static_cast<double>(n) / volume;
}

/// How many may be within the radius of a point before it is crowded there.
std::size_t most_uncrowded(const Matrix& points, double radius, double threshold) {
    const double volume = ball_volume(points.cols, radius);
    const auto is_uncrowded = [&](std::size_t count) {
        return count == 0 || !(density(count, points.rows, volume) > threshold);
    };
    const auto counts = std::views::iota(std::size_t{0}, points.rows + 1);
    return *std::ranges::partition_point(counts, is_uncrowded) - 1;
}

}  // namespace

double ball_volume(std::size_t dimension, double radius) {
    const double half = static_cast<double>(dimension) / 2;
    return std::pow(std::numbers::pi, half) / std::tgamma(half + 1) *
           std::pow(radius, static_cast<double>(dimension));
}

std::size_t neighbour_count(const NearestOptions& options, std::size_t n) {
    const std::size_t k =
        options.count_rule == CountRule::given
            ? options.k
            : static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(n))));
    return std::min(k, n);
}

std::vector<std::size_t> nearest(const Matrix& points, std::span<const double> reference,
                                 std::size_t k) {
    check(points, reference);
    return order_of(distances(points, reference), std::min(k, points.rows));
}

Crowding default_crowding(const Matrix& points, std::span<const double> reference,
                          const NearestOptions& options) {
    const std::size_t k = neighbour_count(options, points.rows);
    const std::vector<std::size_t> found = nearest(points, reference, k);
    if (found.empty()) return {};
    const double reach = std::sqrt(squared_distance(points.row(found.back()), reference));
    const double threshold = density(k, points.rows, ball_volume(points.cols, reach));
    return {options.radius.value_or(reach / 2), options.threshold.value_or(threshold)};
}

Selection nearest_avoiding_density(const Matrix& points,
                                   std::span<const double> reference,
                                   const NearestOptions& options) {
    Selection selection{{}, std::vector<char>(points.rows, 0), {}};
    selection.crowding = default_crowding(points, reference, options);
    const auto [radius, threshold] = selection.crowding;
    if (!(radius >= 0) || !(threshold >= 0))
        throw std::invalid_argument("radius and threshold must not be negative");
    if (points.rows == 0) return selection;
    PointTree tree(points);
    const std::size_t enough = most_uncrowded(points, radius, threshold);
    const std::vector<std::size_t> order =
        order_of(distances(points, reference), points.rows);
    for (const std::size_t index : order) {
        if (!tree.has(index)) continue;
        const auto place = points.row(index);
        tree.remove(index);
        const bool is_crowded =
            tree.count_within(place, radius * radius, enough) > enough;
        const std::size_t neighbour = is_crowded ? tree.nearest(place) : index;
        tree.restore(index);
        if (is_crowded) tree.remove(neighbour);
    }
    const std::size_t k = neighbour_count(options, points.rows);
    selection.nearest.reserve(k);
    for (const std::size_t index : order)
        if (!tree.has(index))
            selection.is_high_density[index] = 1;
        else if (selection.nearest.size() < k)
            selection.nearest.push_back(index);
    return selection;
}

}  // namespace bemcal::stats
