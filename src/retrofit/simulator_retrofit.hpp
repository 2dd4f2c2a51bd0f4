/// What retrofits would save by another program's model of a building: scenarios applied
/// to draws of its posterior, or to the point of a loop around it with the effects that
/// the loop found. Before and after are the program's own runs.
#pragma once

#include "retrofit/setting.hpp"
#include "retrofit/simulator_scenario.hpp"
#include "study/case.hpp"
#include "study/hourly_simulator.hpp"
#include "study/stage.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bemcal::retrofit {

struct SimulatorRetrofitOptions : Setting {
    std::vector<SimulatorScenario> scenarios;
    std::vector<Limits> limits;  ///< [parameters of the program]
};

/// \param building  whose meters the program has hours of, and whose schedule says when
/// it is occupied
std::unique_ptr<study::Stage> make_simulator_retrofit(
    std::string name, const study::Case& building,
    std::shared_ptr<const study::HourlySimulator> simulator, const study::Period& period,
    const SimulatorRetrofitOptions& options);

}  // namespace bemcal::retrofit
