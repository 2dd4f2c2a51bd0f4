/// What a posterior says of meters: for some of its draws every reading of a period is
/// simulated, and drawn with its residual.
#pragma once

#include "posterior/building_model.hpp"
#include "study/hold_out.hpp"

namespace bemcal::posterior {

/// A meter over a period, as predicted.
struct MeterPrediction {
    std::string name, unit;
    physics::Quantity quantity = physics::Quantity::heating;
    physics::Intervals interval;
    std::vector<physics::Seconds> begins;
    std::vector<double> measured;  ///< NaN = missing
    std::vector<double> nominal;   ///< of the building as described
    std::vector<double> mean;      ///< of the simulations
    Matrix draws;                  ///< [draws x readings] with residuals
};

/// \param points  rows that belong together; those that are impossible are left out
/// \param level_change  each draw of an energy meter is multiplied, over the whole
/// period, by exp(level_change N(0, 1)); 0 draws nothing
std::vector<MeterPrediction> predict_meters(const BuildingModel& model,
                                            const BuildingModel::Points& points,
                                            double level_change, Stream& random);

}  // namespace bemcal::posterior
