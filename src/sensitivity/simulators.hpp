/// What a sensitivity study may ask: a building over a period, and paper 1's single hour.
#pragma once

#include "physics/office_hour.hpp"
#include "study/simulator.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::sensitivity {

/// A case over a period: totals of the quantities over it [kWh], for a temperature its
/// mean.
std::shared_ptr<const study::Simulator> make_batch_simulator(
    const study::Case& building, const study::Period& period,
    std::vector<physics::Quantity> quantities);

/// Paper 1's hour (physics/office_hour.hpp): its inputs less the fixed ones are the
/// parameters, heating plus cooling energy is the output. Throws std::invalid_argument
/// for a name that is not one of the 19.
std::shared_ptr<const study::Simulator> make_office_hour_simulator(
    const std::vector<std::pair<std::string, double>>& fixed,
    const physics::OfficeHourAssumptions& assumptions = {});

}  // namespace bemcal::sensitivity
