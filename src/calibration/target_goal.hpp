/// The objectives of an optimisation against single numbers, as a grid has them: totals,
/// months or peaks of a building, or outputs of another program.
///
/// With one objective the distance to the reference point in per cent, as a grid measures
/// it; with NSGA-II the error of each target.
#pragma once

#include "calibration/goal.hpp"
#include "calibration/optimisation_options.hpp"

#include <memory>
#include <vector>

namespace bemcal::calibration {

class TargetGoal : public Goal {
  public:
    /// Throws std::invalid_argument where a target or parameter is not there.
    TargetGoal(const TargetAim& aim, const OptimisationOptions& options);

    const std::vector<physics::Parameter>& parameters() const override {
        return parameters_;
    }
    std::vector<optimise::Variable> variables() const override;
    std::vector<std::string> objectives() const override;
    std::vector<std::string> units() const override;
    Matrix evaluate(const Matrix& points,
                    std::vector<std::string>& failures) const override;
    /// The targets, what is measured, and the errors of `best`; not where a point takes
    /// long: then the objectives say how far it is.
    void describe(std::span<const double> best,
                  study::DatasetBuilder& datasets) const override;
    std::vector<double> in_simulator(std::span<const double> point) const override {
        return whole(point).values;
    }
    bool failures_may_pass() const override {
        return aim_.simulator->failures_may_pass();
    }

  private:
    /// The simulator's points: parameters that are not varied stay nominal.
    Matrix whole(const Matrix& points) const;
    Matrix whole(std::span<const double> point) const;
    std::vector<double> errors_of(std::span<const double> answer) const;  ///< [%]
    std::vector<double> objectives_of(const std::vector<double>& errors) const;

    TargetAim aim_;
    OptimisationOptions options_;
    std::vector<physics::Parameter> parameters_;
    std::vector<std::size_t> varied_;   ///< among the simulator's
    std::vector<std::size_t> columns_;  ///< of the targets among the outputs
};

}  // namespace bemcal::calibration
