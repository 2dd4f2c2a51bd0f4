/// What is stored of chains, in the layout of ArviZ's InferenceData: groups posterior,
/// sample_stats and prior with dimensions (chain, draw); beside them a table of all
/// unknowns, and whether they have converged.
#pragma once

#include "posterior/chain_draws.hpp"

namespace bemcal::posterior {

/// The first summary has the values of all unknowns.
study::Conclusion conclude_chains(const std::string& stage, const Posterior& posterior,
                                  const ChainOptions& options, const ChainDraws& draws);

/// \return [n x unknowns] draws from the prior
Matrix draw_prior(const Posterior& posterior, std::size_t n, Stream& random);

/// "not converged: ..." or what chains did not start; empty = all is well.
std::string shortfall_of(const ConvergenceTable& table, const ChainOptions& options,
                         const ChainDraws& draws);

}  // namespace bemcal::posterior
