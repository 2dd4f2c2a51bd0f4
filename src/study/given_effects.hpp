/// Effects as another program is given them: hours at hooks, whatever they follow.
#pragma once

#include "effects/hook_series.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

struct GivenEffect {
    std::string name;
    std::vector<effects::HookSeries> at;  ///< all that it changes
};

/// Times a scale each; those at 0 are left out.
std::vector<GivenEffect> scaled(const std::vector<GivenEffect>& effects,
                                std::span<const double> scales);

}  // namespace bemcal::study
