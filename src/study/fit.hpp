/// How well points fit a case's meters: the numbers kept of each point, and the whole
/// picture of the few points that are looked at closely.
#pragma once

#include "stats/metrics.hpp"
#include "study/case.hpp"

#include <span>
#include <vector>

namespace bemcal::study {

/// The metrics by name, in the order in which results store them.
struct FitNumber {
    const char* name;
    double stats::FitMetrics::* value;
};
inline constexpr FitNumber fit_numbers[] = {
    {"n", &stats::FitMetrics::n},
    {"nmbe", &stats::FitMetrics::nmbe},
    {"cv_rmse", &stats::FitMetrics::cv_rmse},
    {"cv_rmse_n1", &stats::FitMetrics::cv_rmse_n1},
    {"mape", &stats::FitMetrics::mape},
    {"n_left_out", &stats::FitMetrics::n_left_out},
    {"r2", &stats::FitMetrics::r2},
    {"rmse", &stats::FitMetrics::rmse}};

/// Metrics of one meter in one period, at the meter's interval and by calendar month.
struct MeterFit {
    stats::FitMetrics own;
    stats::FitMetrics monthly;
};
MeterFit fit_of(const kernel::Readings& readings, const kernel::ErrorSums& own,
                const kernel::ErrorSums& monthly);

/// Whether every meter that has readings meets ASHRAE Guideline 14: finer than monthly
/// with the hourly limits, by month with the monthly ones.
bool meet_guideline_14(const std::vector<kernel::Readings>& readings,
                       const std::vector<MeterFit>& fits, stats::Resolution resolution);

/// Sum over meters of the squared CV(RMSE) at their own interval; NaN where a point
/// failed.
double score_of(const std::vector<MeterFit>& fits);

/// One meter over one period, simulated and measured at the meter's interval.
struct MeterSeries {
    std::vector<physics::Seconds> begins;
    std::vector<double> simulated, measured;
    MeterFit fit;
};

/// With its metrics. \param simulated  at the readings' intervals
MeterSeries compared(std::vector<double> simulated, const physics::TimeAxis& period,
                     const kernel::Readings& readings);

/// A building over a period by the plain simulation: every meter, and quantities by step.
struct CloseLook {
    std::vector<MeterSeries> meters;
    /// [quantities x n_steps]; NaN where it failed.
    std::vector<std::vector<double>> hourly;
};
CloseLook look_closely(const Case& building, const Period& period,
                       const physics::Drive& drive, std::span<const double> point,
                       const std::vector<physics::Quantity>& hourly);

}  // namespace bemcal::study
