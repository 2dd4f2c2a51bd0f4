/// What the data could tell of a parameter, in plain words.
#pragma once

#include <string>

namespace bemcal::posterior {

/// The first that holds, in this order; the limits stand in `ContractionLimits`.
enum class Finding {
    fixed,       ///< it is not asked for
    unknown,     ///< there are fewer than two draws
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

/// An end of the range, with the share of draws and of the prior in its neighbourhood.
struct Edge {
    const char* name;
    double at, draws, prior;
};

/// What a finding is made of.
struct Evidence {
    double contraction, shift;
    double spread;  ///< sd over that of the prior
    std::string partner;
    double correlation;  ///< with it; may be NaN
    Edge edge;
};

struct Statement {
    Finding finding;
    std::string words;
};
Statement judge(const Evidence& evidence, const ContractionLimits& limits);

}  // namespace bemcal::posterior
