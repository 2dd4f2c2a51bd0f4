/// The standing model, linear about its way through training, at every hook where it may
/// lack something.
#pragma once

#include "functions/linear_steps.hpp"
#include "loop/baseline.hpp"

#include <vector>

namespace bemcal::loop {

struct LinearModel {
    std::vector<effects::Effect> hooks;  ///< each as an effect that is always there
    functions::LinearSteps steps;        ///< its hooks are these
};

/// Hooks that the building lacks, and those that cannot move both ways, are left out.
LinearModel linear_model(const LoopData& data, const Place& place,
                         const Standing& standing);

}  // namespace bemcal::loop
