/// What a staged calibration is judged by: its periods simulated with the values before
/// and after, and how far the data hold each parameter.
#pragma once

#include "calibration/staged_goal.hpp"
#include "calibration/staged_path.hpp"
#include "study/datasets.hpp"

#include <string>
#include <vector>

namespace bemcal::calibration {

/// Values that a period is simulated with.
struct Version {
    std::string name;
    std::vector<double> point;  ///< [parameters of the case]
};

/// Periods seen together with several versions.
struct Comparison {
    std::string folder;  ///< of its datasets, below the study: "calibration/envelope"
    std::vector<std::string> periods;
    std::vector<Version> versions;
    std::vector<std::size_t> meters;  ///< of the case
};

class StagedJudge {
  public:
    /// Case and models must outlive it.
    StagedJudge(const study::Case& building, const PeriodModels& models, double accuracy)
        : building_(building), models_(models), accuracy_(accuracy) {}

    /// Series and errors of every version, the periods taken together; shares of the
    /// readings within 0.5 and within the accuracy; the errors' cumulative distribution.
    void compare(const Comparison& comparison, study::DatasetBuilder& datasets) const;

    /// Standard deviations of a stage's estimates, in the parameters' units; NaN where
    /// the stage leaves one alone, or it is discrete. What it carries over is as unsure
    /// as its own stage left it, and widens them. [parameters of the case]
    /// \param carried  standard deviations of what is carried over, taken as independent;
    ///                 NaN: certain
    std::vector<double> spread_of(const CalibrationStage& stage, const StageFound& found,
                                  const std::vector<std::size_t>& meters,
                                  const std::vector<double>& carried) const;

  private:
    /// An unknown of a stage, over a range that is flat.
    struct Varied {
        std::size_t parameter;
        double range, step;  ///< parameter's unit
    };
    std::vector<Varied> varied_in(const StageFound& found,
                                  const std::vector<double>& carried) const;
    study::CloseLook look(const std::string& period, std::span<const double> point) const;

    const study::Case& building_;
    const PeriodModels& models_;
    double accuracy_;
};

}  // namespace bemcal::calibration
