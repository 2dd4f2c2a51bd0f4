/// What an optimisation minimises.
#pragma once

#include "optimise/space.hpp"
#include "study/datasets.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::calibration {

/// Const means shareable: `evaluate` is called by many threads at once.
class Goal {
  public:
    virtual ~Goal() = default;
    /// Those that are varied.
    virtual const std::vector<physics::Parameter>& parameters() const = 0;
    /// Discrete where the parameter is; they start at the nominal values.
    virtual std::vector<optimise::Variable> variables() const = 0;
    /// Names and units.
    virtual std::vector<std::string> objectives() const = 0;
    virtual std::vector<std::string> units() const = 0;
    /// [n x objectives], NaN where a point failed (with its reason) or is not admitted.
    virtual Matrix evaluate(const Matrix& points,
                            std::vector<std::string>& failures) const = 0;
    /// What the best point is like.
    virtual void describe(std::span<const double> best,
                          study::DatasetBuilder& datasets) const = 0;
    /// How the best point falls short of the readings, in a sentence; empty = it does
    /// not.
    virtual std::string shortfall_of(std::span<const double> best) const {
        static_cast<void>(best);
        return {};
    }
    /// The values of all parameters of a simulator at a point; empty = there is none.
    virtual std::vector<double> in_simulator(std::span<const double> point) const {
        static_cast<void>(point);
        return {};
    }
    /// Whether the readings of a building are met, not other targets.
    virtual bool is_of_readings() const { return false; }
    /// Whether a failed point may succeed when it is done again.
    virtual bool failures_may_pass() const { return false; }
};

}  // namespace bemcal::calibration
