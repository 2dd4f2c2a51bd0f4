/// Coefficients of one point for the fast kernel: each regime's affine map of a step
/// (step_map.hpp), contracted with what drives the zone, and each row's constants.
#pragma once

#include "kernel/regime.hpp"

namespace bemcal::kernel {

/// Where a lane's coefficients go: the lane's first element of [columns x lanes] tables.
struct LaneTables {
    double* regimes;
    double* rows;
    int lanes;
};

/// Of one regime and its rows. Throws CannotSimulate where the zone leaves the method
/// (make_network, control_at).
void write_coefficients(const ZonePlan& plan, int regime,
                        const physics::Building& building, const physics::Drive& drive,
                        physics::Network& network, physics::StepMaps& maps,
                        const LaneTables& tables);

/// Gives lanes [first, all) those of the lane before them.
/// \param tables  of lane 0
void repeat_coefficients(const ZonePlan& plan, int regime, int first,
                         const LaneTables& tables);

/// The lane's state before the warm-up, all temperatures alike.
/// \param state  the lane's first element of [states x lanes]
void write_start(const ZonePlan& plan, double theta_start, double* state, int lanes);

}  // namespace bemcal::kernel
