/// The way back from the kernel's coefficients to a building's numbers: reverse-mode
/// differentiation of affine.cpp by hand. Its cost does not depend on how many of the
/// numbers are parameters.
#pragma once

#include "kernel/regime.hpp"

namespace bemcal::kernel {

/// Where a lane's adjoints stand: its first element of [columns x lanes] tables.
struct LaneAdjoints {
    const double* regimes;
    const double* rows;
    int lanes;
};

/// Scratch, so that nothing is allocated.
struct NetworkPair {
    physics::Network network;
    physics::StepMaps maps;
    physics::Network of_network;
};

/// Of write_coefficients: adds to the building's adjoints.
void pull_coefficients(const ZonePlan& plan, const physics::Building& building,
                       const physics::Drive& drive, NetworkPair& scratch,
                       const LaneAdjoints& tables, physics::Building& of_building);

}  // namespace bemcal::kernel
