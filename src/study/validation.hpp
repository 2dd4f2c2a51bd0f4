/// A calibrated model held against readings, as paper 1 does (its section 4, Table 10 and
/// Figures 8 to 11), beside the model as it was before: errors by reading, day and month,
/// verdicts of ASHRAE Guideline 14, typical and design days, and whether the predictive
/// intervals are as wide as they should be.
///
/// Errors are predicted - measured. Days and months: complete_intervals.hpp. For air
/// temperature they are means, and CV(RMSE) depends on the zero of the scale: see rmse.
#pragma once

#include "physics/meters.hpp"
#include "stats/coverage.hpp"
#include "stats/metrics.hpp"
#include "study/hold_out.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

/// A meter over a period; before and after may be empty, as may the draws.
struct Predicted {
    physics::Quantity quantity = physics::Quantity::heating;
    physics::Intervals interval;
    std::span<const physics::Seconds> begins;  ///< [n] rising
    std::span<const double> measured;          ///< [n] NaN = missing
    std::span<const double> before;            ///< [n] of the building as described
    std::span<const double> after;  ///< [n] mean of the posterior's predictions
    const Matrix* draws = nullptr;  ///< [draws x n] with their residuals
};

template <class T>
struct BeforeAfter {
    T before, after;
};

/// ASHRAE Guideline 14-2014, both numbers with n - 1: at most 10 % and 30 % hourly, 5 %
/// and 15 % monthly. With n they stand in FitMetrics.
struct Verdict {
    double nmbe = 0, cv_rmse = 0;  ///< NaN for fewer than two readings
    bool is_met = false;
};
Verdict verdict_of(const stats::FitMetrics& metrics, stats::Resolution resolution);

/// A month's total (or mean temperature).
struct MonthError {
    physics::Seconds begin{};
    double measured = 0;
    BeforeAfter<double> predicted;
    BeforeAfter<double> relative;  ///< (predicted - measured) / measured [-]
};

/// One day by its readings.
struct DayFit {
    physics::Seconds day{};
    BeforeAfter<stats::FitMetrics> metrics;
    std::vector<std::size_t> readings;  ///< indices, missing ones too: the day's profile
};

struct Validation {
    BeforeAfter<stats::FitMetrics> own, daily, monthly;  ///< own: the meter's interval
    BeforeAfter<Verdict> hourly_verdict;  ///< of `own`, for intervals below a month
    BeforeAfter<Verdict> monthly_verdict;
    std::vector<MonthError> months;
    std::vector<DayFit> mid_months;   ///< the 15th of each month
    std::vector<DayFit> design_days;  ///< 21 January and 21 July
    stats::Coverage own_coverage, monthly_coverage;
    stats::Pit own_pit;
};
Validation validate(const Predicted& meter);

/// The validation of a part of the readings.
struct PartValidation {
    std::string part;  ///< "all", "training", "held_out_hours", "held_out_weeks"
    Validation validation;
};

/// Of all readings, and of each role that some of them have. No roles (a period that is
/// held out as a whole): all only. \param roles  [n] or empty
std::vector<PartValidation> validate_parts(const Predicted& meter,
                                           std::span<const Role> roles);

}  // namespace bemcal::study
