/// Quantiles of a sample.
#pragma once

#include <span>

namespace bemcal::stats {

/// At the place p (n - 1) + 1 of the sorted values, between neighbours in proportion
/// (type 7 of Hyndman and Fan 1996, doi:10.1080/00031305.1996.10473566); NaN of none.
/// Predictive intervals take another place: coverage.hpp.
double quantile_of_sorted(std::span<const double> sorted, double p);

}  // namespace bemcal::stats
