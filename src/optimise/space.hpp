/// What is varied: numbers in a range, and numbers from a table.
///
/// A position has a coordinate for each variable: its share of the range, from 0 to 1, or
/// the number of its value in the table, whole wherever it is evaluated. Optimisers move
/// positions; whoever evaluates them sees values.
#pragma once

#include "base/matrix.hpp"
#include "base/nan.hpp"
#include "base/random.hpp"

#include <span>
#include <vector>

namespace bemcal::optimise {

struct Variable {
    double least = 0, most = 1;
    std::vector<double> values{};  ///< discrete: one of these; least and most are unused
    double start = nan;            ///< default: the middle
};

using Position = std::vector<double>;

class Space {
  public:
    /// Throws std::invalid_argument where there is no variable, or one has no range.
    explicit Space(std::vector<Variable> variables);

    std::size_t size() const { return variables_.size(); }
    bool is_discrete(std::size_t k) const { return !variables_[k].values.empty(); }
    /// Coordinate k goes from 0 to this.
    double highest(std::size_t k) const;

    Position start() const;
    Position draw(Stream& random) const;  ///< uniform
    /// Onto the mesh of that width and into the ranges; 0: into the ranges only.
    Position snapped(Position position, double mesh) const;

    /// [positions x variables]
    Matrix values_of(std::span<const Position> positions) const;

  private:
    double value_of(std::size_t k, double coordinate) const;

    std::vector<Variable> variables_;
};

}  // namespace bemcal::optimise
