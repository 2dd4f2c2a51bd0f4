/// How far the unknowns of a model in the loop may be from the truth.
#pragma once

#include "loop/baseline.hpp"
#include "loop/found.hpp"

#include <vector>

namespace bemcal::loop {

/// Standard deviations of a model's unknowns, in their units [unknowns]: what noise
/// leaves them, errors counted `misfit` times; more where twelfths of the period say
/// otherwise (delete-a-block jackknife); and what the model itself leaves coefficients,
/// and others with them.
std::vector<double> deviations_of(const LoopData& data, const Standing& standing,
                                  double misfit);

/// What the readings say of a model's unknowns, in their scales and without priors:
/// J w J^T. [unknowns x unknowns]
Matrix information_of(const LoopData& data, const Standing& standing, double misfit);

/// How its unknowns go together, by the normal equations and by what the model itself
/// leaves open. [unknowns x unknowns]
Matrix correlations_of(const LoopData& data, const Standing& standing, double misfit);

/// The standard deviation of an effect's coefficient, in its unit: of the last model
/// (`deviations_of`), of what was found about its shape and about what is missing.
double deviation_of(const Found& found, double of_last);

}  // namespace bemcal::loop
