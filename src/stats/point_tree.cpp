/// A k-d tree whose points can be taken away: how many are left around a place, which is
/// nearest. A box's distances sum terms that bound those of its points, in the same
/// order; as rounding keeps order, they bound the rounded ones too.
/// Source: Bentley 1975. Left out: points that are added or moved. In many dimensions it
/// is no faster than a plain loop.
#include "stats/point_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bemcal::stats {
namespace {

constexpr std::size_t points_of_a_leaf = 8;
constexpr auto no_index = std::numeric_limits<std::uint32_t>::max();

std::size_t nodes_for(std::size_t n) {
    std::size_t leaves = 1;
    while (n / leaves > points_of_a_leaf) leaves *= 2;
    return 2 * leaves - 1;
}

}  // namespace

double squared_distance(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

PointTree::PointTree(const Matrix& points)
    : nodes_(nodes_for(points.rows)),
      bounds_(nodes_.size() * 2 * points.cols),
      indices_(points.rows),
      position_(points.rows),
      leaf_(points.rows),
      sorted_(points.rows, points.cols),
      is_left_(points.rows, 1) {
    std::iota(indices_.begin(), indices_.end(), std::uint32_t{0});
    build(points, 0, 0, points.rows);
    for (std::size_t k = 0; k < indices_.size(); ++k) {
        position_[indices_[k]] = static_cast<std::uint32_t>(k);
        std::ranges::copy(points.row(indices_[k]), sorted_.row(k).begin());
    }
    for (std::size_t node = nodes_.size(); node-- > 0;) refresh(node);
}

void PointTree::build(const Matrix& points, std::size_t node, std::size_t begin,
                      std::size_t end) {
    nodes_[node].begin = static_cast<std::uint32_t>(begin);
    nodes_[node].end = static_cast<std::uint32_t>(end);
    bound(points, node);
    if (is_leaf(node)) {
        for (std::size_t k = begin; k < end; ++k)
            leaf_[indices_[k]] = static_cast<std::uint32_t>(node);
        return;
    }
    const std::size_t middle = begin + (end - begin) / 2, column = widest(node);
    const auto at = [&](std::size_t k) {
        return indices_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    std::nth_element(at(begin), at(middle), at(end), [&](auto a, auto b) {
        return points(a, column) < points(b, column);
    });
    build(points, 2 * node + 1, begin, middle);
    build(points, 2 * node + 2, middle, end);
}

/// The box around a node's points.
void PointTree::bound(const Matrix& points, std::size_t node) {
    const std::size_t d = points.cols;
    double* const bounds = bounds_.data() + node * 2 * d;
    for (std::size_t c = 0; c < d; ++c) {
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (std::size_t k = nodes_[node].begin; k < nodes_[node].end; ++k) {
            least = std::min(least, points(indices_[k], c));
            most = std::max(most, points(indices_[k], c));
        }
        bounds[2 * c] = least;
        bounds[2 * c + 1] = most;
    }
}

/// The column in which a node's box is widest.
std::size_t PointTree::widest(std::size_t node) const {
    const std::size_t d = sorted_.cols;
    const double* const bounds = bounds_.data() + node * 2 * d;
    std::size_t column = 0;
    double width = -1;
    for (std::size_t c = 0; c < d; ++c) {
        if (bounds[2 * c + 1] - bounds[2 * c] <= width) continue;
        width = bounds[2 * c + 1] - bounds[2 * c];
        column = c;
    }
    return column;
}

/// Counts what is left in a node, of leaves from the points, else from its children.
void PointTree::refresh(std::size_t node) {
    Node& own = nodes_[node];
    if (!is_leaf(node)) {
        const Node &left = nodes_[2 * node + 1], &right = nodes_[2 * node + 2];
        own.n_left = left.n_left + right.n_left;
        own.first = std::min(left.first, right.first);
        return;
    }
    own.n_left = 0;
    own.first = no_index;
    for (std::size_t k = own.begin; k < own.end; ++k) {
        if (is_left_[k] == 0) continue;
        ++own.n_left;
        own.first = std::min(own.first, indices_[k]);
    }
}

void PointTree::set(std::size_t index, char is_left) {
    is_left_[position_[index]] = is_left;
    std::size_t node = leaf_[index];
    refresh(node);
    while (node > 0) {
        node = (node - 1) / 2;
        refresh(node);
    }
}

PointTree::Reach PointTree::reach(std::size_t node, std::span<const double> place) const {
    const double* const bounds = bounds_.data() + node * 2 * place.size();
    Reach sum{0, 0};
    for (std::size_t c = 0; c < place.size(); ++c) {
        const double below = bounds[2 * c] - place[c];
        const double above = place[c] - bounds[2 * c + 1];
        const double least = std::max({below, above, 0.0});
        const double most = std::max(-below, -above);
        sum.least += least * least;
        sum.most += most * most;
    }
    return sum;
}

std::size_t PointTree::count(std::size_t node, std::span<const double> place,
                             double square, std::size_t enough) const {
    const Node& own = nodes_[node];
    if (own.n_left == 0) return 0;
    const auto [least, most] = reach(node, place);
    if (least > square) return 0;
    if (most <= square) return own.n_left;
    std::size_t n = 0;
    if (is_leaf(node)) {
        for (std::size_t k = own.begin; k < own.end; ++k)
            if (is_left_[k] != 0 && squared_distance(place, sorted_.row(k)) <= square)
                ++n;
        return n;
    }
    n = count(2 * node + 1, place, square, enough);
    return n > enough ? n : n + count(2 * node + 2, place, square, enough - n);
}

void PointTree::search_leaf(const Node& leaf, std::span<const double> place,
                            Nearest& found) const {
    for (std::size_t k = leaf.begin; k < leaf.end; ++k) {
        if (is_left_[k] == 0) continue;
        const double square = squared_distance(place, sorted_.row(k));
        if (square < found.square ||
            (square == found.square && indices_[k] < found.index))
            found = {square, indices_[k]};
    }
}

/// The child that is nearer first. Nothing of a box can win that begins further off than
/// what is found, or as far with later points; of a box that is one place the first does.
void PointTree::search(std::size_t node, std::span<const double> place,
                       Nearest& found) const {
    const Node& own = nodes_[node];
    if (own.n_left == 0) return;
    const auto [least, most] = reach(node, place);
    if (least > found.square || (least == found.square && own.first > found.index))
        return;
    if (least == most) {
        found = {least, own.first};
    } else if (is_leaf(node)) {
        search_leaf(own, place, found);
    } else {
        const std::size_t left = 2 * node + 1, right = left + 1;
        const bool right_first = reach(right, place).least < reach(left, place).least;
        search(right_first ? right : left, place, found);
        search(right_first ? left : right, place, found);
    }
}

std::size_t PointTree::nearest(std::span<const double> place) const {
    Nearest found;
    search(0, place, found);
    return found.index;
}

}  // namespace bemcal::stats
