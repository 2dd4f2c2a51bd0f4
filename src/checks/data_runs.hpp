/// Stretches of one value: fills that a logger or a publisher put where nothing was
/// measured, and zeros that stand for nothing measured.
///
/// Both rules look at the series alone. A fill is longer than chance allows where values
/// repeat as often as they do elsewhere in the series. A zero stands for a missing
/// reading where the meter is well above zero at the same hours of all the days around;
/// heating that is off by season, night or weekend is not, since then its neighbours are
/// zeros too. Left out: one value put into many gaps, which then seems to repeat.
#pragma once

#include "checks/data_readings.hpp"

namespace bemcal::checks {

/// Runs of at least `least` readings with the same value; NaN ends a run. Zeros when
/// `zeros`, other values when not.
std::vector<Run> constant_runs(std::span<const double> readings, int least, bool zeros);

/// The smallest difference between two of the values; 0 with fewer than two.
double quantum_of(std::span<const double> values);

/// Runs of a value other than 0 that chance makes in fewer than one series of 10,000, of
/// half a day at least (a day of a temperature). Left out: a meter's value below 50
/// quanta (10 if it stays for a month), where rounding hides what moves.
std::vector<Run> constant_fills(const DataSeries& series);

/// Runs of zeros that mean missing. Weather-driven meters: 16 h to two weeks (a mild
/// night or a few rounded readings are no outage), cut off and back at once, and on
/// either side at most a tenth of zeros and the lowest readings above 0.3 of the usual
/// one. Others: the lowest readings around, at those hours, stand well apart from 0.
std::vector<Run> missing_zeros(const DataSeries& series);

}  // namespace bemcal::checks
