/// What a posterior says of meters: for some of its draws every reading of a period is
/// simulated, and drawn with its residual.
#pragma once

#include "study/building_model.hpp"
#include "study/hold_out.hpp"

namespace bemcal::study {

/// A meter over a period, as predicted.
struct MeterPrediction {
    std::string name, unit;
    physics::Quantity quantity = physics::Quantity::heating;
    physics::Interval interval = physics::Interval::hourly;
    std::vector<physics::Seconds> begins;
    std::vector<double> measured;  ///< NaN = missing
    std::vector<double> nominal;   ///< of the building as described
    std::vector<double> mean;      ///< of the simulations
    Matrix draws;                  ///< [draws x readings] with residuals
};

/// \param parameters, residuals  [draws x ...] rows that belong together
/// Rows whose point is impossible are left out.
std::vector<MeterPrediction> predict_meters(const BuildingModel& model,
                                            const Matrix& parameters,
                                            const Matrix& residuals, Stream& random);

}  // namespace bemcal::study
