/// Which bias of a posterior its own draws tell of, so that it need not be said.
#pragma once

#include "posterior/predictive.hpp"

namespace bemcal::posterior {

/// Beyond this NMBE [-] a bias is said whatever the draws hold.
constexpr double most_own_bias = 0.25;

/// Whether the NMBE [-] is at most that, and what was metered in all lies within the
/// central 98 % of the draws' sums over the same readings. Never without draws.
bool draws_tell_bias(const MeterPrediction& meter, double nmbe);

}  // namespace bemcal::posterior
