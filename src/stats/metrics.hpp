/// Error metrics of ASHRAE Guideline 14 and paper 1. Errors are simulated - measured.
#pragma once

#include <span>

namespace bemcal::stats {

struct FitMetrics {
    double n = 0;     ///< pairs compared
    double nmbe = 0;  ///< sum of errors / sum of measured [-]
    /// sqrt(mean squared error) / mean of measured, with n [-]; NaN unless that is above
    /// 0
    double cv_rmse = 0;
    double cv_rmse_n1 = 0;  ///< the same with n - 1 (Guideline 14 with p = 1) [-]
    double mape = 0;        ///< mean |error| / |measured| over non-zero readings [-]
    double n_left_out = 0;  ///< readings of zero, left out of mape
    double r2 = 0;          ///< squared correlation [-]
    double rmse = 0;        ///< [unit of the meter]
};

/// From sums over pairs, see kernel::ErrorSums.
struct PairSums {
    double n = 0, error = 0, square = 0;
    double simulated = 0, simulated_square = 0, product = 0;
    double measured = 0, measured_square = 0;
    double n_relative = 0, relative = 0;
};
FitMetrics metrics_of(const PairSums& sums);
/// Pairs with a NaN on either side are left out.
FitMetrics metrics_of(std::span<const double> simulated,
                      std::span<const double> measured);

/// CV(RMSE); where it is not defined the RMSE itself, so that points can be ranked.
double relative_error(const FitMetrics& metrics);

/// ASHRAE Guideline 14-2014: at most 10 % NMBE and 30 % CV(RMSE) hourly, 5 % and 15 %
/// monthly.
enum class Resolution { hourly, monthly };
bool meets_guideline_14(const FitMetrics& metrics, Resolution resolution);

}  // namespace bemcal::stats
