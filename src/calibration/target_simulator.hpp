/// What a building is held against as a set of single numbers: totals of a period, values
/// of its months, highest hours; and the same of its meters.
#pragma once

#include "study/simulator.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::calibration {

enum class Statistic {
    period,  ///< total over the period [kWh], of a temperature its mean [degC]
    months,  ///< the same of each calendar month: as many outputs
    peak     ///< highest hour: mean power [kW], or temperature [degC]
};

struct OutputSpec {
    physics::Quantity quantity = physics::Quantity::electricity;
    Statistic statistic = Statistic::period;
};

/// "gas", "gas 2015-04" and so on, "peak gas".
std::vector<study::Output> outputs_of(const OutputSpec& spec, const study::Case& building,
                                      const study::Period& period);

/// The outputs of all specifications, one after the other.
std::shared_ptr<const study::Simulator> make_target_simulator(
    const study::Case& building, const study::Period& period,
    std::vector<OutputSpec> specs);

/// What the case's meter of that index shows for the outputs of a specification. Throws
/// std::invalid_argument where readings are missing that the numbers need.
std::vector<double> measured_outputs(const OutputSpec& spec, const study::Case& building,
                                     const study::Period& period, std::size_t meter);

}  // namespace bemcal::calibration
