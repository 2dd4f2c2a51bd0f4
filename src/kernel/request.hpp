/// What is asked of points, and what they answer.
#pragma once

#include "physics/meters.hpp"

#include <string>
#include <vector>

namespace bemcal::kernel {

/// Readings of a meter over a period, one for each of its intervals; NaN = missing.
struct Readings {
    physics::Quantity quantity = physics::Quantity::heating;
    physics::Intervals interval;
    std::vector<double> values;  ///< [kWh] or [degC]
};

/// Sums over the intervals that have a reading; all that the error metrics need.
struct ErrorSums {
    double n = 0, error = 0, square = 0;                      ///< of simulated - measured
    double simulated = 0, simulated_square = 0, product = 0;  ///< product with measured
    double n_relative = 0, relative = 0;  ///< |error| / |measured| where it is not 0
};

/// What is wanted of every point.
struct Request {
    std::vector<physics::Quantity>
        annual;  ///< totals (means for temperature) over the period
    std::vector<physics::Quantity>
        monthly;                     ///< the same for each calendar month of the period
    std::vector<Readings> readings;  ///< error sums against each, at its own interval
                                     ///< and, where that is finer, also by calendar month
};

struct PointAnswer {
    std::string failure;            ///< empty = it went well
    std::vector<double> annual;     ///< [annual.size()] kWh or degC
    std::vector<double> monthly;    ///< [monthly.size() x n_months]
    std::vector<ErrorSums> errors;  ///< [readings.size()] at the reading's interval
    /// [readings.size()]; a month counts where all of its readings' intervals compared
    /// are summed.
    std::vector<ErrorSums> monthly_errors;
};

/// A meter that is to be predicted over the batch's period.
struct Channel {
    physics::Quantity quantity = physics::Quantity::heating;
    physics::Intervals interval;
};

/// What a run of a response has memory for: readings alone, or also the way back.
enum class Way { there, there_and_back };

}  // namespace bemcal::kernel
