/// The elimination behind a step's map with all that stands between the network and the
/// map: what the map is made of (step_map.hpp) and its derivative goes back through
/// (adjoint/step_map_adjoint.hpp).
#pragma once

#include "physics/hour.hpp"
#include "physics/linear_form.hpp"
#include "physics/network.hpp"

namespace bemcal::physics {

/// The emitter's first-order lag, exact for a constant command:
/// power(t) = command + (power(0) - command) exp(-t / tau).
struct Emitter {
    double kept = 0, mean_kept = 0;  ///< of power(0) at the end of a step, over it [-]
    LinearForm mean, after;
};

/// Balances from the air inwards, each on forms in place of numbers: D theta = right
/// side, per node.
struct StepParts {
    RadiantSplit split;
    Emitter emitter;
    double C_air, D_air, H_1;  ///< [W/K]
    LinearForm air;
    double H_2, D_s;
    LinearForm surface;
    double C_second, kept_second, H_second;  ///< second mass, its mean eliminated
    double H_3, C_m, D_m;
    LinearForm mass;
    LinearForm theta_m, theta_s;  ///< means of the step
};
StepParts make_step_parts(const Network& network, double dt);

/// C.4 to C.11 of the standard hour in one go.
struct StandardParts {
    double per_air, k_1, H_1, H_2, per_surface, to_mass;
    double C, H, per_mass;
    double air_per_theta_m;
};
StandardParts make_standard_parts(const Network& network, double dt);

}  // namespace bemcal::physics
