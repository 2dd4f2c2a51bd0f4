/// How far the data moved each parameter from what was believed of it, and in plain words
/// what they can and cannot tell.
#pragma once

#include "base/matrix.hpp"
#include "posterior/finding.hpp"
#include "study/space.hpp"

#include <string>
#include <vector>

namespace bemcal::posterior {

/// The four comparisons are NaN where the parameter is fixed or has too few draws.
struct ParameterMove {
    std::string name;
    double prior_mean = 0, prior_sd = 0, posterior_mean = 0, posterior_sd = 0;
    double contraction = 0;  ///< 1 - variance / variance of the prior
    double shift = 0;        ///< difference of means / sd of the prior
    double range_share = 0;  ///< width of the central 90 % / that of the prior
    std::string partner;     ///< the parameter with the strongest correlation
    double correlation = 0;  ///< with it; NaN without another that varies
    Finding finding = Finding::fixed;
    std::string words;  ///< a sentence with its numbers, of the finding
};

/// Correlations are those of the draws' values (Pearson's).
/// \param draws  [draws x coordinates] in the coordinates' units
std::vector<ParameterMove> moves_of(const std::vector<study::Coordinate>& coordinates,
                                    const Matrix& draws,
                                    const ContractionLimits& limits = {});

}  // namespace bemcal::posterior
