/// A calibrated model of the loop in any period: its place there, and what it predicts
/// hour by hour.
#pragma once

#include "loop/baseline.hpp"
#include "loop/found_function.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::loop {

/// The place of a model in any period: with its structure, the loads that effects follow,
/// the columns of functions.
Place place_in(const LoopData& data, const Standing& standing,
               const std::vector<FoundFunction>& functions,
               std::shared_ptr<const physics::Drive> drive);

/// Predictions of every hour of a drive's period. [channels x hours] Throws
/// CannotSimulate with the hour and what is impossible there.
std::vector<std::vector<double>> hours_of(
    const LoopData& data, const Standing& standing,
    const std::vector<FoundFunction>& functions,
    const std::shared_ptr<const physics::Drive>& drive);

}  // namespace bemcal::loop
