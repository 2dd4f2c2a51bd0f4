/// Chains, part by part: a warm-up, then rounds of draws, each from the state that the
/// last one ended in; between the two they may share what they learnt. The chains of a
/// call run in lockstep, so that their points are evaluated together; a chain's draws
/// depend on its seed and number only, not on its company, nor on where its rounds are
/// computed.
#pragma once

#include "sampling/density.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace bemcal::sampling {

enum class Method { nuts, random_walk, gibbs };
const char* name_of(Method method);

struct SamplerOptions {
    Method method = Method::nuts;
    int n_warm_up = 500;
    double target_acceptance = 0;  ///< 0 = the method's own: 0.8 nuts, 0.234, 0.44
    int most_depth = 10;           ///< of a nuts trajectory: 2^depth steps
    bool dense_metric = true;      ///< nuts, random_walk: full covariance, else diagonal
    /// nuts without tempering: a chain climbs to the mode above its start and takes its
    /// first metric from the curvature there (climb.hpp).
    bool climbs = true;
    int n_start_candidates = 16;  ///< the best of so many starts is taken
    /// Inverse temperatures, 1 first, falling; more than one: a tempered chain.
    std::vector<double> inverse_temperatures{1};
    int thin = 1;  ///< transitions per draw
    /// The warm-up moves those between the first and the last until all neighbours swap
    /// equally often.
    bool adapt_temperatures = true;
};

/// Whether a chain begins with a climb.
bool climbs_first(const SamplerOptions& options);

/// A chain's round: 0 is the warm-up, without draws.
struct ChainTask {
    std::uint64_t seed = 0;
    std::uint32_t chain = 0, round = 0;
    std::vector<double> state;  ///< what the last round ended in; unused in round 0
};

/// Columns of ChainPart::statistics.
enum class Statistic {
    log_prior,
    log_likelihood,
    acceptance,  ///< mean acceptance probability of the transition
    step_size,
    n_steps,    ///< gradient or density evaluations of the transition
    depth,      ///< nuts
    diverging,  ///< 1 = the trajectory's energy error exceeded 1000
    swapped,    ///< tempered: share of swaps accepted between neighbours
};
constexpr std::size_t n_statistics = 8;
const char* name_of(Statistic statistic);

struct ChainPart {
    Matrix draws;               ///< [n_draws x dimension], on the density's own scale
    Matrix statistics;          ///< [n_draws x n_statistics]
    std::vector<double> state;  ///< for the next round
    std::string failure;        ///< no start with a finite density, ...; empty = none
};

/// After round 0: gives every chain that climbed the metric and the step size of one of
/// them, that with the upper quartile of all step sizes. A metric learnt in a few hundred
/// transitions is poor in some chains, whose trajectories are then many times longer; a
/// long step in whitened coordinates is the mark of a good one. Deterministic; empty
/// states (of chains that failed) stay empty.
void share_metric(const Density& density, const SamplerOptions& options,
                  std::vector<std::vector<double>>& states);

/// Round 0 ignores n_draws. One density serves all chains of the call.
std::vector<ChainPart> run_chains(Density& density, const SamplerOptions& options,
                                  const std::vector<ChainTask>& tasks, int n_draws);

}  // namespace bemcal::sampling
