/// The objective of one stage of a calibration: its periods taken together, as a function
/// of all parameters of the case.
#pragma once

#include "calibration/period_model.hpp"
#include "calibration/staged_options.hpp"
#include "study/fit.hpp"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bemcal::calibration {

/// Models of periods, by name.
using PeriodModels = std::map<std::string, std::unique_ptr<PeriodModel>>;

class StageGoal {
  public:
    /// The models must outlive it. Throws std::invalid_argument where a period has no
    /// reading of the stage's meters.
    StageGoal(const study::Case& building, const PeriodModels& models,
              const CalibrationStage& stage);

    /// Its meters, by their index in the case.
    const std::vector<std::size_t>& meters() const { return meters_; }
    /// \param points  [n x parameters of the case]  \return [n]; NaN where one failed
    std::vector<double> evaluate(const Matrix& points,
                                 std::vector<std::string>& failures) const;

  private:
    double objective_of(const std::vector<const kernel::PointAnswer*>& answers) const;
    double minus_log_prior(std::span<const double> point) const;

    OptimisationOptions fit_;
    std::vector<stats::Prior> priors_;  ///< [parameters of the case]; fixed: no part
    std::vector<double> share_;         ///< [meters] independent errors per reading
    std::vector<std::size_t> meters_;
    std::vector<const PeriodModel*> models_;  ///< [periods]
    std::vector<AskedMeters> asked_;          ///< [periods]
};

}  // namespace bemcal::calibration
