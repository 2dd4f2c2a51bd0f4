/// From samples in the unit cube to points in the parameters' ranges.
#pragma once

#include "base/matrix.hpp"
#include "physics/parameters.hpp"

#include <span>
#include <vector>

namespace bemcal::study {

/// \param unit  [n x parameters] in [0, 1)  \return [n x parameters] within least..most
Matrix in_ranges(Matrix unit, std::span<const physics::Parameter> parameters);

/// And back, of one value: where it lies in the range, on the scale 0 to 1.
double on_scale(double value, const physics::Parameter& parameter);

/// The nominal building's values. [parameters]
std::vector<double> nominal_point(std::span<const physics::Parameter> parameters);

/// The same as n equal rows. [n x parameters]
Matrix nominal_points(std::span<const physics::Parameter> parameters, std::size_t n);

/// The same as a matrix of one row.
Matrix nominal_row(std::span<const physics::Parameter> parameters);

/// Rows [first, first + n) of a matrix.
Matrix part_of(const Matrix& matrix, std::size_t first, std::size_t n);

/// -1 or 1 where a value lies at the lower or upper end of its range, within a thousandth
/// of it; else 0.
double end_of_range(double value, double least, double most);

}  // namespace bemcal::study
