/// Error metrics from sums over pairs: NMBE, CV(RMSE), MAPE, R2, and Guideline 14's
/// verdict.
/// Source: ASHRAE Guideline 14-2014 with p = 1; paper 1, its misprints mended. MAPE
/// leaves out readings of 0 and says how many; a metric that is not defined is NaN, as
/// CV(RMSE) is of readings whose mean is not above 0.
#include "stats/metrics.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stats {
namespace {

double squared_correlation(const PairSums& s) {
    const double covariance = s.n * s.product - s.simulated * s.measured;
    const double simulated = s.n * s.simulated_square - s.simulated * s.simulated;
    const double measured = s.n * s.measured_square - s.measured * s.measured;
    if (!(simulated > 0) || !(measured > 0)) return nan;
    return std::min(1.0, covariance * covariance / (simulated * measured));
}

void add(PairSums& s, double simulated, double measured) {
    const double error = simulated - measured;
    s.n += 1;
    s.error += error;
    s.square += error * error;
    s.simulated += simulated;
    s.simulated_square += simulated * simulated;
    s.product += simulated * measured;
    s.measured += measured;
    s.measured_square += measured * measured;
    if (measured == 0) return;
    s.n_relative += 1;
    s.relative += std::abs(error) / std::abs(measured);
}

double ratio(double numerator, double denominator) {
    return denominator != 0 ? numerator / denominator : nan;
}

}  // namespace

FitMetrics metrics_of(const PairSums& s) {
    FitMetrics m;
    m.n = s.n;
    m.n_left_out = s.n - s.n_relative;
    const double mean = ratio(s.measured, s.n);
    m.rmse = s.n > 0 ? std::sqrt(s.square / s.n) : nan;
    m.nmbe = ratio(s.error, s.measured);
    if (mean > 0) {
        m.cv_rmse = m.rmse / mean;
        m.cv_rmse_n1 = s.n > 1 ? std::sqrt(s.square / (s.n - 1)) / mean : nan;
    } else {
        m.cv_rmse = m.cv_rmse_n1 = nan;
    }
    m.mape = ratio(s.relative, s.n_relative);
    m.r2 = squared_correlation(s);
    return m;
}

FitMetrics metrics_of(std::span<const double> simulated,
                      std::span<const double> measured) {
    require(simulated.size() == measured.size(),
            "simulated and measured differ in length");
    PairSums sums;
    for (std::size_t k = 0; k < simulated.size(); ++k)
        if (!std::isnan(simulated[k]) && !std::isnan(measured[k]))
            add(sums, simulated[k], measured[k]);
    return metrics_of(sums);
}

double relative_error(const FitMetrics& m) {
    return std::isnan(m.cv_rmse) ? m.rmse : m.cv_rmse;
}

/// The guideline divides both sums by n - p with p = 1, which nmbe does not.
bool meets_guideline_14(const FitMetrics& m, Resolution resolution) {
    if (!(m.n > 1)) return false;
    const bool hourly = resolution == Resolution::hourly;
    return std::abs(m.nmbe) * m.n / (m.n - 1) <= (hourly ? 0.10 : 0.05) &&
           std::abs(m.cv_rmse_n1) <= (hourly ? 0.30 : 0.15);
}

}  // namespace bemcal::stats
