/// Functions of what a building may follow, as columns with a prior: each is a sum of
/// columns with coefficients that are independent, of mean 0 and one variance. Over the
/// training period functions have mean 0, and those of variance 1 a mean square of 1.
#pragma once

#include "base/matrix.hpp"
#include "functions/points.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::functions {

/// A function of drivers, learned from one period and laid on the steps of any.
struct Basis {
    std::string driver;  ///< "hour of the week"
    Points points{};
    /// [points x columns]: values of all columns at each point.
    Matrix at_points{};

    std::size_t n_columns() const { return at_points.cols; }
};

/// \param drivers  [n_drivers][steps]
/// \return         [steps x columns]
Matrix columns_of(const Basis& basis, const std::vector<std::vector<double>>& drivers);

/// The constant.
Basis constant();
/// At points that are given. \param training  [n_drivers][steps]
Basis basis_at(std::string driver, Points points,
               const std::vector<std::vector<double>>& training);
/// Points 0 to 71: 24 hours of working days, of Saturdays, of Sundays. Neighbouring hours
/// are alike over some three hours, and day classes share half of their variance.
Basis hours_of_week(std::string driver, std::span<const double> training);
/// Hours of the week from a day on, 0 before it. What all days share is not taken off.
/// \param day  among the years
Basis hours_from(std::string driver, std::span<const double> hours,
                 std::span<const double> years, double day);
/// Hats over quantiles of the driver in training, its ends held beyond them; smooth.
Basis smooth_of(std::string driver, std::span<const double> training);
/// The two of them together, what each alone explains taken off: hours of the day of two
/// classes of day (points 0 to 47) times a slow driver.
Basis hours_times(std::string driver, std::span<const double> hours,
                  std::span<const double> slow);
/// A level that wanders: a random walk by the fortnight of `years` (points of the
/// beginning of each); the last level goes on. Where no season repeats, in under two
/// years, it may as well be one: then the mean of the last level and of that of the same
/// time of the year goes on.
Basis wandering(std::string driver, std::span<const double> years);

}  // namespace bemcal::functions
