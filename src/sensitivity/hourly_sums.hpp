/// Sums over base points that hourly Sobol indices are made of, step by step.
///
/// Base points go through time in companies of sixteen. Point k of every company adds to
/// sums of its own (LaneSums, [steps x 3 x lanes] for each of the kernel's groups), and
/// the sixteen are added up in an order that is written out, so that the bits depend on
/// no compiler, lane count or instruction set. Outputs are shifted by a nominal
/// trajectory: sums stay well conditioned, and a base point that is nominal in every row
/// adds exactly nothing.
#pragma once

#include "base/lane_array.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace bemcal::sensitivity {

constexpr std::size_t sixteen = 16;

/// Three sums for each step of a chunk and each of sixteen points.
class LaneSums {
  public:
    LaneSums(std::size_t lanes, std::size_t n_steps);

    std::size_t lanes() const { return lanes_; }
    std::size_t n_groups() const { return groups_.size(); }
    /// [steps x 3 x lanes] of points [k lanes, (k + 1) lanes)
    double* group(std::size_t k) { return groups_[k].data(); }
    const double* group(std::size_t k) const { return groups_[k].data(); }
    void clear();

  private:
    std::size_t lanes_;
    std::vector<LaneArray> groups_;
};

/// Sums over base points, for every step of a period; a row for each term.
class HourlySums {
  public:
    HourlySums(std::size_t dimension, std::size_t n_steps);

    std::size_t n_steps() const { return n_steps_; }

    /// n steps from `begin` (a multiple of four) on: sums of a, b, a^2 + b^2.
    void add_base(std::size_t begin, std::size_t n, const LaneSums& sums);
    /// The same steps of input i: sums of b (ab_i - a), ab_i - a, (ab_i - a)^2.
    void add_input(std::size_t i, std::size_t begin, std::size_t n, const LaneSums& sums);

    /// [n_steps x terms]: sum of a, of b, of a^2 + b^2, then for each i of b (ab_i - a),
    /// of ab_i - a, and of (ab_i - a)^2.
    std::vector<double> values() const;
    static std::size_t n_terms(std::size_t dimension) { return 3 + 3 * dimension; }

  private:
    double* term(std::size_t row, std::size_t step) {
        return sums_.data() + row * padded_ + step;
    }

    std::size_t dimension_, n_steps_, padded_;
    std::vector<double> sums_;  ///< [n_terms x padded_]: steps rounded up to whole fours
};

/// What the sums of one step say, relative to the variance.
struct StepEstimate {
    double mean = 0;            ///< over the design, less the shift
    double variance = 0;        ///< over the rows A and B
    std::vector<double> parts;  ///< [2 d] S1 variance for each input, then ST variance
};
/// \param sums  the terms of a step   \param n  base points in them
StepEstimate estimate(std::span<const double> sums, double n);

}  // namespace bemcal::sensitivity
