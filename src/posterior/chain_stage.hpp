/// Chains as a stage: an item is a few chains in lockstep; round 0 warms them up, each
/// later round adds draws, until all unknowns have converged or the budget is spent.
///
/// What is sampled is a `Posterior`; this file knows no building and no emulator.
#pragma once

#include "posterior/posterior_options.hpp"
#include "posterior/sampled_posterior.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>

namespace bemcal::posterior {

std::unique_ptr<study::Stage> make_chain_stage(std::string name,
                                               std::shared_ptr<const Posterior> posterior,
                                               const ChainOptions& options);

}  // namespace bemcal::posterior
