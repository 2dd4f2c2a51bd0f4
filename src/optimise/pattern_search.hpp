/// Hooke and Jeeves 1961 (J. ACM 8(2)), as batches of points.
///
/// An exploration tries every variable up and down by the step, all from the same centre
/// and at once, then the sums of the best of these moves at once; the original tries one
/// variable after the other, a round of simulations for each. A pattern move goes as far
/// again as the last success, and explores there before it is judged. Where nothing is
/// better the step is halved (Wetter's GPS, GenOpt manual 3.1, section 5.2). A discrete
/// variable is tried 1, 2, 4, 8, ... places up and down its table at any step.
#pragma once

#include "optimise/search.hpp"
#include "sampling/task.hpp"

namespace bemcal::optimise {

struct PatternOptions {
    double first_step = 0x1p-4, last_step = 0x1p-20;  ///< of the range; powers of 2
    std::vector<bool> held{};  ///< of each variable: it stays as it is; empty: none does
};

/// From a point (evaluated here if it was not) to the end of the last step.
sampling::Task<Found> pattern_search(Search& search, PatternOptions options,
                                     Position start);

}  // namespace bemcal::optimise
