/// Calibration by MCMC of the simulator itself: one building, or several that share what
/// they are made of (pooled or hierarchical), and predictions of what was held out and of
/// buildings never seen.
#pragma once

#include "posterior/meter_response.hpp"
#include "posterior/posterior_options.hpp"
#include "posterior/sampled_posterior.hpp"
#include "study/case.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::posterior {

/// Several buildings must have the same parameters and meters. Those named in
/// options.unseen are predicted only. Throws std::invalid_argument where a meter is
/// unknown, where no meter has a reading in the training period, or where a building's
/// zones are coupled and the sampler wants derivatives.
std::unique_ptr<study::Stage> make_posterior(std::string name,
                                             const std::vector<study::Case>& buildings,
                                             const PosteriorOptions& options);

/// The same of one building whose readings another source answers: all of its parameters
/// are calibrated. Throws std::invalid_argument where a meter is unknown or none has a
/// reading in the training period.
std::shared_ptr<const Posterior> make_posterior_through(
    const std::shared_ptr<const ResponseSource>& source, const study::Case& building,
    const PosteriorOptions& options);

}  // namespace bemcal::posterior
