/// From adjoints of a zone's part of its air system at a step to those of the building.
#pragma once

#include "physics/air_hour.hpp"

namespace bemcal::adjoint {

/// Of air_hour; loads and temperature of the zone are the caller's.
void pull_air_hour(const physics::Building& building, std::size_t zone,
                   const physics::Drive& drive, int step, const physics::AirHour& of_hour,
                   physics::Building& of_building);

}  // namespace bemcal::adjoint
