/// Calibration by Kennedy and O'Hagan's model as a stage of chains: unknowns are the
/// calibrated inputs, in physical units, and the hyperparameters; what follows are
/// predictions of the true process at the field points (paper 1, steps 3 to 5).
#pragma once

#include "emulator/density.hpp"
#include "posterior/chain_stage.hpp"
#include "posterior/koh_options.hpp"

#include <memory>
#include <string>

namespace bemcal::posterior {

inline constexpr const char* koh_kind = "kennedy_ohagan";  ///< as the result says it

/// Throws std::invalid_argument where data, priors and form do not fit together.
std::shared_ptr<const Posterior> make_koh_posterior(const KohOptions& options);
std::unique_ptr<study::Stage> make_koh_stage(std::string name, const KohOptions& options);

/// Rough time of the chains' whole budget on one core [s].
double koh_seconds(const KohOptions& options);

/// The prior of (x - least) / (most - least). Throws std::invalid_argument for kinds that
/// are not of one family on both scales.
stats::Prior on_unit_scale(const stats::Prior& prior);

}  // namespace bemcal::posterior
