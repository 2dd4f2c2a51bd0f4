/// Where on the line coefficients of unknown size stand (`study::Coordinate::centring`).
#pragma once

#include "posterior/posterior_density.hpp"

namespace bemcal::posterior {

/// How far readings alone tell each unknown that has a size among the unknowns: 0 not at
/// all, 1 exactly. Found at the middle of the priors, with the gradients of the
/// likelihood. [n_free], 1 for all others
std::vector<double> shares_of_readings(
    const std::shared_ptr<const PosteriorParts>& parts);

/// Sets the space, and with it the arrangement of a building that is alone, to these
/// shares.
void centre(const std::shared_ptr<PosteriorParts>& parts);

}  // namespace bemcal::posterior
