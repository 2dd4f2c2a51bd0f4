/// The way of a staged calibration: stage after stage, an optimiser each, from what it is
/// told alone. Made anew and told the same, it is where it was.
#pragma once

#include "base/nan.hpp"
#include "calibration/staged_options.hpp"
#include "optimise/optimiser.hpp"
#include "study/case.hpp"

#include <memory>
#include <vector>

namespace bemcal::calibration {

/// What a stage started from and found. All vectors [parameters of the case].
struct StageFound {
    std::vector<double> start, value;
    std::vector<double> least, most;  ///< NaN where the stage leaves it alone
    double objective = nan;           ///< the best
    std::size_t n_evaluated = 0;
};

class StagedPath {
  public:
    StagedPath(const std::vector<physics::Parameter>& parameters,
               const std::vector<study::ParameterPrior>& priors,
               const std::vector<CalibrationStage>& stages);

    std::size_t stage() const { return found_.size() - 1; }  ///< the one at work
    /// Points that wait for their objective. [n x parameters of the case]; none: done.
    Matrix next_points() const;
    void tell(const std::vector<double>& objectives);

    const std::vector<StageFound>& found() const { return found_; }

  private:
    void begin_stage();
    void take_best();
    const std::vector<double>& carried(const std::string& from) const;
    optimise::Variable variable_of(std::size_t parameter, StageFound& found) const;

    std::vector<physics::Parameter> parameters_;
    std::vector<study::ParameterPrior> priors_;
    std::vector<CalibrationStage> stages_;
    std::vector<double> nominal_;
    std::vector<StageFound> found_;    ///< of the stages that have begun
    std::vector<std::size_t> varied_;  ///< parameters of the stage at work
    std::unique_ptr<optimise::Optimiser> optimiser_;
};

}  // namespace bemcal::calibration
