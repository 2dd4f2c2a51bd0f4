/// A chain as its caller sees it: how it samples, what a round of it starts from, and
/// what it brings.
#pragma once

#include "base/matrix.hpp"

#include <cstddef>
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

}  // namespace bemcal::sampling
