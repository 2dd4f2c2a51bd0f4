/// How many independent draws the mean of autocorrelated chains is worth.
///
/// Geyer's initial positive and monotone sequence on the autocovariances, averaged over
/// chains and put in relation to the variance between them (Vehtari et al. 2021, eq.
/// 10-13; posterior 1.4).
#pragma once

#include "base/matrix.hpp"

#include <vector>

namespace bemcal::stats {

/// NaN for fewer than 3 draws, for draws that are all equal or not all finite. At most
/// S log10(S) for S draws in all.
/// \param draws  [chains x draws], as they are: split them before where wanted
double effective_size(const Matrix& draws);

/// [draws] autocovariance at lag 0, 1, ..., divided by the number of draws, mean over the
/// chains, each about its own mean; by FFT.
std::vector<double> mean_autocovariance(const Matrix& draws);

}  // namespace bemcal::stats
