/// Chains' answers as numbers: how an item's answer is written and read again, and what
/// the draws of all rounds say of convergence.
#pragma once

#include "posterior/posterior_options.hpp"
#include "posterior/sampled_posterior.hpp"
#include "sampling/chain.hpp"
#include "stats/convergence.hpp"
#include "study/stage.hpp"

#include <string>
#include <vector>

namespace bemcal::posterior {

/// The numbers of an item: its chains one after the other.
std::vector<double> pack_parts(const std::vector<sampling::ChainPart>& parts);

/// How items, rounds and chains count.
struct ChainLayout {
    int n_chains = 0, chains_per_item = 1;
    std::size_t dimension = 0;

    int n_groups() const { return (n_chains + chains_per_item - 1) / chains_per_item; }
    int round_of(int item) const { return item / n_groups(); }
    int first_chain_of(int item) const { return item % n_groups() * chains_per_item; }
    int n_chains_of(int item) const;
};

/// Each chain's state after the last round in `answers`; empty = the chain failed.
std::vector<std::vector<double>> last_states(
    const ChainLayout& layout, const std::vector<study::ItemAnswer>& answers);
std::vector<double> pack_states(const std::vector<std::vector<double>>& states);
std::vector<std::vector<double>> unpack_states(const std::vector<double>& packed);

ChainDraws gather_draws(const ChainLayout& layout, int first_chain,
                        const std::vector<study::ItemAnswer>& answers);

/// Of every unknown and, last, the log density.
struct ConvergenceTable {
    std::vector<std::string> names;
    std::vector<stats::Convergence> rows;
    double worst_rhat() const;  ///< NaN where one is not defined
    double least_ess() const;   ///< of bulk and tail
    bool meets(const ChainOptions& options) const;
};
ConvergenceTable convergence_table(const Posterior& posterior, const ChainDraws& draws);

/// [chains x draws] of each unknown in turn.
std::vector<Matrix> draws_of_unknowns(const Posterior& posterior,
                                      const ChainDraws& draws);
/// [chains x draws] of the log posterior density.
Matrix log_densities(const ChainDraws& draws);

}  // namespace bemcal::posterior
