/// Points from which some are taken away: how many are left around a place, and which is
/// the nearest of them.
///
/// A k-d tree of boxes (Bentley 1975), each of which knows how many points are left in it
/// and the smallest of their indices; so neither crowds nor many points in one place cost
/// more than the boxes on the way. Distances are those of a plain loop over all points,
/// to the bit. Not nanoflann: it counts no points in a box, and sums distances its own
/// way.
#pragma once

#include "base/matrix.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace bemcal::stats {

/// Sum of squares in the order of the coordinates.
double squared_distance(std::span<const double> a, std::span<const double> b);

class PointTree {
  public:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    /// \param points  [n x d] of finite coordinates; fewer than 2^32 - 1
    explicit PointTree(const Matrix& points);

    bool has(std::size_t index) const { return is_left_[position_[index]] != 0; }
    void remove(std::size_t index) { set(index, 0); }
    void restore(std::size_t index) { set(index, 1); }

    /// Points left whose squared distance from the place is at most `square`; more than
    /// `enough` are not counted to the end.
    std::size_t count_within(std::span<const double> place, double square,
                             std::size_t enough) const {
        return count(0, place, square, enough);
    }
    /// Of the points left; the first of several; none where there is none.
    std::size_t nearest(std::span<const double> place) const;

  private:
    /// Children of node i are 2 i + 1 and 2 i + 2.
    struct Node {
        std::uint32_t begin = 0, end = 0;  ///< of its points, sorted by leaf
        std::uint32_t n_left = 0, first = 0;
    };
    struct Reach {
        double least, most;  ///< squared distance of a place from a box
    };
    struct Nearest {
        double square = std::numeric_limits<double>::infinity();
        std::size_t index = none;
    };

    bool is_leaf(std::size_t node) const { return node >= nodes_.size() / 2; }
    void build(const Matrix& points, std::size_t node, std::size_t begin,
               std::size_t end);
    std::size_t widest(std::size_t node) const;
    void bound(const Matrix& points, std::size_t node);
    void refresh(std::size_t node);
    void set(std::size_t index, char is_left);
    Reach reach(std::size_t node, std::span<const double> place) const;
    std::size_t count(std::size_t node, std::span<const double> place, double square,
                      std::size_t enough) const;
    void search(std::size_t node, std::span<const double> place, Nearest& found) const;
    void search_leaf(const Node& leaf, std::span<const double> place,
                     Nearest& found) const;

    std::vector<Node> nodes_;
    std::vector<double> bounds_;                  ///< [nodes x 2 x d] least, most
    std::vector<std::uint32_t> indices_;          ///< by position
    std::vector<std::uint32_t> position_, leaf_;  ///< of each point
    Matrix sorted_;                               ///< the points by position
    std::vector<char> is_left_;                   ///< by position
};

}  // namespace bemcal::stats
