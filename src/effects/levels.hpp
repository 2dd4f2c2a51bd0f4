/// Few values in place of many, so that the fast simulation has as many regimes only.
#pragma once

#include <vector>

namespace bemcal::effects {

/// The profile with at most `n_levels` different values: zeros stay, the others are put
/// into equally wide bins and replaced by their bin's mean, so that the profile's mean
/// stays. A profile with no more values than that is left as it is.
std::vector<double> levelled(const std::vector<double>& profile, int n_levels);

}  // namespace bemcal::effects
