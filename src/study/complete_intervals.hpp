/// Readings by calendar day and month.
///
/// A day or month counts where readings of at least 90 % of its hours (`complete_share`)
/// are there; predictions are then summed over the hours of those readings only, so that
/// both sides stand for the same time. A bill counts as a month of its own. A period's
/// cut first and last month seldom count, nor do days of which every fourth hour is held
/// out.
#pragma once

#include "base/matrix.hpp"
#include "physics/meters.hpp"

#include <span>
#include <vector>

namespace bemcal::study {

constexpr double complete_share = 0.9;

/// A day or month, and its readings that are not missing.
struct CompleteInterval {
    physics::Seconds begin{};  ///< of the day or month
    std::vector<std::size_t> readings;
};

/// Those that count, in order of time; none where the readings' own interval is longer
/// than what is asked for. \param by  daily or monthly
std::vector<CompleteInterval> complete_intervals(std::span<const physics::Seconds> begins,
                                                 std::span<const double> measured,
                                                 const physics::Intervals& own,
                                                 physics::Interval by);

/// Sums over each, or means for temperature. \param values  [readings]
std::vector<double> totals_of(const std::vector<CompleteInterval>& intervals,
                              std::span<const double> values, physics::Quantity quantity);

/// The same for each row. [draws x readings] -> [draws x intervals]
Matrix totals_of(const std::vector<CompleteInterval>& intervals, const Matrix& draws,
                 physics::Quantity quantity);

}  // namespace bemcal::study
