/// The objectives of an optimisation: how far a building is from its meters over a
/// period.
#pragma once

#include "calibration/goal.hpp"
#include "calibration/optimisation_options.hpp"
#include "calibration/screening_plan.hpp"
#include "study/fit.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bemcal::calibration {

class MeterGoal : public Goal {
  public:
    MeterGoal(const study::Case& building, const OptimisationOptions& options);

    const std::vector<physics::Parameter>& parameters() const override {
        return building_.parameters;
    }
    const study::Case& building() const { return building_; }
    std::vector<optimise::Variable> variables() const override;
    std::vector<std::string> objectives() const override;
    std::vector<std::string> units() const override;
    bool is_of_readings() const override { return true; }
    Matrix evaluate(const Matrix& points,
                    std::vector<std::string>& failures) const override;
    /// Nominal and `best`, every meter and period.
    std::string shortfall_of(std::span<const double> best) const override;
    void describe(std::span<const double> best,
                  study::DatasetBuilder& datasets) const override;

  private:
    std::vector<double> objectives_of(const kernel::PointAnswer& answer) const;
    double error_of(const stats::FitMetrics& metrics) const;

    OptimisationOptions options_;
    study::Case building_;
    std::vector<std::unique_ptr<PeriodModel>> models_;  ///< [periods]
    std::size_t period_ = 0;
    std::vector<std::size_t> meters_;  ///< of the case
    AskedMeters asked_;                ///< these in that period
};

/// Their indices in the building, in the order of the names, which weights have too.
/// Throws std::invalid_argument for a name that no meter has, or that stands twice.
std::vector<std::size_t> meters_named(const study::Case& building,
                                      const std::vector<std::string>& names);

/// Paper 2, eq. 4, with its weights. A correlation that is not defined counts as none;
/// fewer than three readings have no such term.
double weighted_error(const stats::FitMetrics& metrics,
                      const OptimisationOptions& options);

/// The chosen objective of one meter.
double objective_term(const stats::FitMetrics& metrics,
                      const OptimisationOptions& options);

}  // namespace bemcal::calibration
