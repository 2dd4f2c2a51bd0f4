/// How far processes promise too much: their squared errors at runs that neither they nor
/// the components have seen, over their variances there.
///
/// Components of few runs bend towards these runs: a score that is left out of its
/// process alone is foretold better than a new one. So folds of runs are left out of the
/// components as well, which takes no more than the runs' Gram matrix. Scales stay.
#pragma once

#include "emulator/score_process.hpp"

namespace bemcal::emulator {

/// At least 1. [components]
/// \param gram    [runs x runs] of the weighted runs less their mean
/// \param scales  [components]
std::vector<double> variance_factors(const Matrix& points, const Matrix& gram,
                                     std::span<const ScoreScales> scales);

}  // namespace bemcal::emulator
