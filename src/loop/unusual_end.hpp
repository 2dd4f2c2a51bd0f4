/// Where a fit left a parameter, if that needs a word: a number that could not go on, or
/// went where nobody expected it, may stand for what the description lacks.
#pragma once

#include "study/fit_model.hpp"

#include <string>

namespace bemcal::loop {

/// Further than noise takes a number whose prior is right.
/// \param x  in prior standard deviations from its mean
bool is_far_from_prior(const study::FitUnknown& unknown, double x);

/// "at the lower end of its range: 0.4", "3.7 prior sd from its mean: 3.65 K"; "" =
/// neither.
/// \param x  in prior standard deviations from its mean
/// \param is_added  by a refinement, which does nothing at 0: such an end is none
std::string unusual_end(const study::FitUnknown& unknown, double x, bool is_added);

}  // namespace bemcal::loop
