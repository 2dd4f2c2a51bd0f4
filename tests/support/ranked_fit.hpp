/// Chains on a posterior whose truth is known, and the rank of the truth among their
/// draws.
#pragma once

#include "sampling/chains.hpp"
#include "support/rank_uniformity.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace bemcal::test {

struct SimulatedFit {
    std::vector<std::string> names;
    std::vector<int> ranks;  ///< of the truth among n_ranks draws, for each free unknown
};

struct DrawPlan {
    std::uint64_t seed;
    int n_chains, n_draws;  ///< draws of a chain, after its warm-up
};

/// [draws x dimension], the chains' draws taken in turn.
inline Matrix draws_of(sampling::Density& density,
                       const sampling::SamplerOptions& sampler, const DrawPlan& plan) {
    std::vector<sampling::ChainTask> tasks;
    for (int c = 0; c < plan.n_chains; ++c)
        tasks.push_back({plan.seed, static_cast<std::uint32_t>(c), 0, {}});
    const auto warm = sampling::run_chains(density, sampler, tasks, 0);
    for (std::size_t c = 0; c < tasks.size(); ++c) {
        tasks[c].round = 1;
        tasks[c].state = warm[c].state;
    }
    const auto parts = sampling::run_chains(density, sampler, tasks, plan.n_draws);
    const auto n_draws = static_cast<std::size_t>(plan.n_draws);
    Matrix all(tasks.size() * n_draws, density.dimension());
    for (std::size_t d = 0; d < n_draws; ++d)
        for (std::size_t c = 0; c < tasks.size(); ++c)
            std::ranges::copy(parts[c].draws.row(d),
                              all.row(d * tasks.size() + c).begin());
    return all;
}

/// \param truth  [columns of draws] on the scale of the draws
inline SimulatedFit ranked(const std::vector<std::string>& names,
                           const std::vector<double>& truth, const Matrix& draws,
                           int n_ranks) {
    SimulatedFit fit{names, {}};
    for (std::size_t f = 0; f < names.size(); ++f) {
        std::vector<double> column(draws.rows);
        for (std::size_t r = 0; r < draws.rows; ++r) column[r] = draws(r, f);
        fit.ranks.push_back(rank_of(truth[f], column, n_ranks));
    }
    return fit;
}

}  // namespace bemcal::test
