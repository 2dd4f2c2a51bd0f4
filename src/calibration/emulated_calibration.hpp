/// A calibration of another program's model on a building's meters, by few runs of it: an
/// emulator of its hours, learned from these runs, answers the calibration's points.
#pragma once

#include "calibration/period_model.hpp"
#include "study/case.hpp"
#include "study/hourly_simulator.hpp"
#include "study/stage.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace bemcal::calibration {

/// Makes a calibration of a building whose periods have such models.
using CalibrationOf = std::function<std::unique_ptr<study::Stage>(
    const study::Case& building, const MakePeriodModel& model)>;

struct EmulatedOptions {
    const char* kind = "";  ///< of the calibration, as its result has it
    int n_runs = 80;
    std::uint64_t seed = 0;
    std::vector<std::string> periods;  ///< that are calibrated on
};

/// The building as the program has it: with its parameters, and the meters alone that it
/// has hours of.
study::Case case_of_simulator(const study::Case& building,
                              const study::HourlySimulator& simulator);

/// First the runs, then the calibration, then a run at its best point. Throws
/// std::invalid_argument where the runs are too few for the parameters, or the
/// calibration does not fit the building.
std::unique_ptr<study::Stage> make_emulated_calibration(
    std::string name, const study::Case& building,
    std::shared_ptr<const study::HourlySimulator> simulator,
    const EmulatedOptions& options, CalibrationOf calibration);

}  // namespace bemcal::calibration
