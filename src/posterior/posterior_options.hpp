/// What a job says of a calibration by MCMC.
#pragma once

#include "sampling/chains.hpp"
#include "stats/residual_model.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace bemcal::posterior {

/// Chains, and when they are enough: checked at fixed counts of draws only.
struct ChainOptions {
    sampling::SamplerOptions sampler;
    std::uint64_t seed = 0;
    int n_chains = 16;
    int first_chain = 0;      ///< number of the first one: arrays of a job differ in it
    int chains_per_item = 8;  ///< in lockstep
    int draws_per_round = 100;
    int most_draws = 4000;  ///< per chain: the budget
    double target_rhat = 1.01, target_ess = 400;
};

/// How buildings of one posterior hang together.
enum class Pooling {
    none,    ///< each building has a posterior of its own
    full,    ///< one value of each parameter for all
    partial  ///< hierarchical: each building has its own, drawn from a common population
};

struct PosteriorOptions {
    ChainOptions chains;
    stats::ResidualOptions residuals;
    std::string period;                   ///< for training; empty = the case's first
    std::vector<std::string> parameters;  ///< that are calibrated; empty = all
    std::vector<std::string> meters;      ///< empty = all with readings in the period
    double hold_out_weeks = 0;  ///< share of whole weeks kept from the likelihood
    double hold_out_hours = 0;  ///< share of the other readings, drawn at random
    int n_predictive = 200;     ///< draws that are simulated for predictions
    /// The likelihood's power (Miller and Dunson 2019,
    /// doi:10.1080/01621459.2018.1469995): below 1 where errors hang together in ways
    /// that the residual model does not know.
    double reading_weight = 1;
    /// Standard deviation of what the logarithm of an energy meter's level does in a year
    /// for reasons that no description tells; it grows with the root of time.
    double level_change = 0;
    /// Predictions of other periods have errors that last for so long [weeks], of the
    /// size that training shows (lasting_errors.hpp); 0 = none beyond the likelihood's.
    double lasting_weeks = 0;
    Pooling pooling = Pooling::none;
    std::vector<std::string> unseen;  ///< buildings that are predicted only
    int simulator_runs = 80;          ///< of another program, at most
};

}  // namespace bemcal::posterior
