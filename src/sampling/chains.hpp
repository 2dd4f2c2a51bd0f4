/// Chains, part by part: a warm-up, then rounds of draws, each from the state that the
/// last one ended in; between the two they may share what they learnt. The chains of a
/// call run in lockstep, so that their points are evaluated together; a chain's draws
/// depend on its seed and number only, not on its company, nor on where its rounds are
/// computed.
#pragma once

#include "sampling/chain.hpp"
#include "sampling/density.hpp"
#include "sampling/tally.hpp"

#include <vector>

namespace bemcal::sampling {

/// After round 0: gives every chain that climbed the metric and the step size of one of
/// them, that with the upper quartile of all step sizes. A metric learnt in a few hundred
/// transitions is poor in some chains, whose trajectories are then many times longer; a
/// long step in whitened coordinates is the mark of a good one. Deterministic; empty
/// states (of chains that failed) stay empty.
void share_metric(const Density& density, const SamplerOptions& options,
                  std::vector<std::vector<double>>& states);

/// Round 0 ignores n_draws. One density serves all chains of the call.
/// \param tally  counts the transitions as they are made; nullptr = nobody looks
std::vector<ChainPart> run_chains(Density& density, const SamplerOptions& options,
                                  const std::vector<ChainTask>& tasks, int n_draws,
                                  Tally* tally = nullptr);

}  // namespace bemcal::sampling
