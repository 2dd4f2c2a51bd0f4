/// How far the data moved each parameter from what was believed of it, and in plain words
/// what they can and cannot tell.
#pragma once

#include "base/matrix.hpp"
#include "study/space.hpp"

#include <string>
#include <vector>

namespace bemcal::study {

/// The first that holds, in this order; the limits stand in `ContractionLimits`.
enum class Finding {
    fixed,       ///< it is not asked for
    at_edge,     ///< the draws crowd at an end of the range
    determined,  ///< much narrower than the prior
    confounded,  ///< tied to another parameter
    wider,       ///< wider than the prior
    as_before,   ///< neither narrower nor elsewhere
    moved,       ///< elsewhere, but hardly narrower
    narrowed     ///< somewhat narrower
};
const char* name_of(Finding finding);

/// What is taken for much and for little.
struct ContractionLimits {
    double edge_strip = 0.05;  ///< share of the range that is an end's neighbourhood
    double edge_share = 0.5;   ///< at_edge: share of the draws in it ...
    double edge_factor = 3;    ///< ... and so many times the prior's share in it
    double determined = 0.9;   ///< contraction: the sd is below 0.32 of the prior's
    double correlation = 0.7;  ///< confounded: as strong as this or stronger
    double wider = -0.2;       ///< contraction: the sd is above 1.1 of the prior's
    double as_before = 0.1;    ///< contraction: the sd is above 0.95 of the prior's ...
    double unmoved = 0.5;      ///< ... and |shift| is below this
};

/// The four comparisons are NaN where the parameter is fixed.
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
/// \param draws  [draws x coordinates] in the coordinates' units, at least two
std::vector<ParameterMove> moves_of(const std::vector<Coordinate>& coordinates,
                                    const Matrix& draws,
                                    const ContractionLimits& limits = {});

}  // namespace bemcal::study
