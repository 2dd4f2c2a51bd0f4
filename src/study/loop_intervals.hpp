/// How far the unknowns of a model in the loop may be from the truth.
#pragma once

#include "study/loop_result.hpp"

#include <vector>

namespace bemcal::study {

/// Standard deviations of a model's unknowns, in their units [unknowns]: what noise
/// leaves them, errors counted `misfit` times; more where twelfths of the period say
/// otherwise (delete-a-block jackknife).
std::vector<double> deviations_of(const LoopData& data, const Standing& standing,
                                  double misfit);

/// The standard deviation of an effect's coefficient, in its unit: of noise, of what was
/// found about its shape and about what is missing, and of the model itself.
double deviation_of(const Found& found, double of_noise, double coefficient);

}  // namespace bemcal::study
