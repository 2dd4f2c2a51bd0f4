/// What the readings leave open: names that do nearly as well as one that was found, and
/// parameters that stay wide.
#pragma once

#include "loop/baseline.hpp"
#include "loop/found.hpp"

#include <string>
#include <vector>

namespace bemcal::loop {

/// Another model that the readings can hardly tell from the one that stands.
struct OtherAnswer {
    std::string question;  ///< "night purge, or windows open in warm weather?"
    std::vector<effects::Effect> effects;  ///< of the other model
    std::vector<double> x;                 ///< [its unknowns] where it stands
    double evidence = 0;  ///< for the model that stands: fall of -2 log likelihood
};

/// Of each effect found those names of its class that can be simulated.
std::vector<OtherAnswer> other_answers(const LoopData& data, const Place& place,
                                       const Standing& last,
                                       const std::vector<Found>& found);

/// Unknowns that are the job's parameters and keep more than half of their prior's
/// standard deviation. \param sds  of all unknowns, in prior standard deviations
std::vector<std::size_t> wide_parameters(const LoopData& data, const Standing& last,
                                         std::span<const double> sds);

}  // namespace bemcal::loop
