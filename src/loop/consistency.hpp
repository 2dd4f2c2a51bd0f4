/// Whether a model is better than another in more unseen blocks of time than by chance:
/// the larger of a t-like sum (a few blocks in which much falls) and Wilcoxon's signed
/// ranks (Biometrics Bulletin 1, 1945; many in which a little falls).
#pragma once

#include <vector>

namespace bemcal::loop {

/// A block as two models leave it.
struct BlockChange {
    double fall = 0;   ///< of its loss, from the first to the second
    double moved = 0;  ///< weighted square of what the predictions differ by
};

/// About standard normal where the models are equally good, a little larger as it is the
/// larger of two. Of the blocks in which the models differ at all, if they are enough to
/// tell how they scatter: an effect of a season is seen in that season.
double consistency_of(const std::vector<BlockChange>& changes);

}  // namespace bemcal::loop
