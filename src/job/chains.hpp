/// The keys of every study with chains, and their reader.
#pragma once

#include "posterior/posterior_options.hpp"
#include "schema/section.hpp"

namespace bemcal::job {

/// Beside `temperatures`, whose default is each kind's own.
inline constexpr schema::Key chain_keys[] = {
    {"study", "sampler", schema::Type::choice, "nuts|random_walk|gibbs", "nuts", 0, 0,
     "nuts: Hamiltonian, with derivatives; the others: Metropolis steps of all "
     "parameters "
     "together, or of one after the other."},
    {"study", "n_chains", schema::Type::integer, "", "16", 1, 100000, ""},
    {"study", "warm_up", schema::Type::integer, "", "500", 1, 1000000,
     "First transitions of a chain, which adapt it and are not kept."},
    {"study", "draws_per_round", schema::Type::integer, "", "100", 2, 1000000,
     "Draws of each chain between two looks at the targets."},
    {"study", "most_draws", schema::Type::integer, "", "4000", 2, 100000000,
     "Per chain; the budget."},
    {"study", "thin", schema::Type::integer, "", "1", 1, 100000,
     "Transitions per draw that is kept."},
    {"study", "target_rhat", schema::Type::number, "-", "1.01", 1, 100,
     "Rank R-hat of every unknown is to be at most this."},
    {"study", "target_ess", schema::Type::number, "", "400", 0, 1e9,
     "Effective draws, bulk and tail, of every unknown at least."},
};

/// Temperatures that the job leaves out stay. Throws UserError.
void read_chains(const schema::Section& section, posterior::ChainOptions& chains);

/// Rounds of a whole budget: the first one is the warm-up.
double rounds_of(const posterior::ChainOptions& chains);

}  // namespace bemcal::job
