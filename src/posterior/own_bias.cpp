/// Holds a meter's total against the totals of its draws, residuals included.
/// Follows from the posterior's own intervals: a mean that lies beside the total by no
/// more than they are wide is no surprise, as of few readings with large residuals.
/// Leaves out which bias matters at all (`study::bias_beyond`).
#include "posterior/own_bias.hpp"

#include "stats/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace bemcal::posterior {
namespace {

constexpr double tail = 0.01;  ///< on either side of the 98 %

/// The sum over the readings that there are.
double sum_where(std::span<const double> measured, std::span<const double> values) {
    double sum = 0;
    for (std::size_t k = 0; k < measured.size(); ++k)
        if (!std::isnan(measured[k])) sum += values[k];
    return sum;
}

/// In rising order.
std::vector<double> totals_of_draws(const MeterPrediction& meter) {
    std::vector<double> totals;
    totals.reserve(meter.draws.rows);
    for (std::size_t r = 0; r < meter.draws.rows; ++r)
        totals.push_back(sum_where(meter.measured, meter.draws.row(r)));
    std::ranges::sort(totals);
    return totals;
}

bool hold_total(const MeterPrediction& meter) {
    const std::vector<double> totals = totals_of_draws(meter);
    const double metered = sum_where(meter.measured, meter.measured);
    return stats::quantile_of_sorted(totals, tail) <= metered &&
           metered <= stats::quantile_of_sorted(totals, 1 - tail);
}

}  // namespace

bool draws_tell_bias(const MeterPrediction& meter, double nmbe) {
    return meter.draws.rows > 0 && std::abs(nmbe) <= most_own_bias && hold_total(meter);
}

}  // namespace bemcal::posterior
