/// What a Kennedy-O'Hagan calibration predicts at its own field points, as datasets.
///
/// Errors are those of the posterior mean of the true process; bc-stan has them with
/// n - 1, so both are given. The intervals are of what was learned from: coverage tells
/// of the fit, not of new points.
#pragma once

#include "emulator/density.hpp"
#include "posterior/chain_stage.hpp"
#include "posterior/koh_options.hpp"

namespace bemcal::posterior {

void add_koh_results(emulator::KohDensity& density, const KohOptions& options,
                     const ChainDraws& draws, study::DatasetBuilder& datasets);

}  // namespace bemcal::posterior
