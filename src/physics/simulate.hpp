/// A period, step by step: the plain version of the whole simulation, couplings included.
#pragma once

#include "physics/drive.hpp"
#include "physics/structure.hpp"

#include <vector>

namespace bemcal::physics {

struct ZoneTrajectory {  ///< each [n_steps - n_warm_up]
    std::vector<double> theta_air, theta_op,
        theta_m;                           ///< [degC]; theta_m at the end of the step
    std::vector<double> heating, cooling;  ///< mean power [W], both >= 0
    std::vector<double> fan{};             ///< of an air system [W]
};

struct Trajectory {
    std::vector<ZoneTrajectory> zones;
};

/// Throws CannotSimulate where a zone leaves the method (make_network) or a value is
/// not finite, naming the zone and the step. All nodes start at drive.theta_start.
Trajectory simulate(const Building& building, const Drive& drive);

}  // namespace bemcal::physics
