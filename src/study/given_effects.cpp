/// Scales what another program is given.
/// Follows from `HookSeries`: factors are scaled as differences are, 1 + scale x value.
/// What an effect without hours does cannot be scaled: it is left out.
#include "study/given_effects.hpp"

#include <algorithm>

namespace bemcal::study {

std::vector<GivenEffect> scaled(const std::vector<GivenEffect>& effects,
                                std::span<const double> scales) {
    std::vector<GivenEffect> all;
    for (std::size_t k = 0; k < std::min(effects.size(), scales.size()); ++k) {
        if (scales[k] == 0 || effects[k].at.empty()) continue;
        all.push_back(effects[k]);
        for (effects::HookSeries& at : all.back().at)
            for (double& value : at.values) value *= scales[k];
    }
    return all;
}

}  // namespace bemcal::study
