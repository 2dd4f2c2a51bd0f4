/// A zone's part of its air system at a step: numbers of the building, laid out for the
/// system's equations (air_system.hpp).
#pragma once

#include "physics/air_system.hpp"
#include "physics/building.hpp"
#include "physics/drive.hpp"

namespace bemcal::physics {

/// Of a zone that has a system.
AirKind air_kind(const Building& building, const Zone& zone, const Drive& drive);

/// Row of the boundary whose air the system's flow is; `outdoors` where it has none.
int supply_boundary(const Zone& zone);

/// Of a zone that has a system; its loads and temperature are left 0.
AirHour air_hour(const Building& building, const Zone& zone, const Drive& drive,
                 int step);

/// What reset adds to the temperature of supply air [K].
double supply_reset(const AirSystem& system, double theta_e);

/// Share of the fan that has come on since the step before [-]. While it stood, leaks
/// made the room's air as moist as outdoors: a fan that starts finds a room of outdoor
/// air.
double fan_start(const AirSystem& system, const Drive& drive, int step);

/// How far the economiser may open at a step [-]: nothing where its limit shuts it.
double open_economiser(const AirSystem& system, const Drive& drive, int step,
                       double theta_e);

/// What coils and fan take for what the zone asks for [W]. Throws CannotSimulate where a
/// number is outside of what has a meaning.
AirLoads system_loads(const Building& building, const Zone& zone, const Drive& drive,
                      int step, const AirLoads& asked, double theta_air);

}  // namespace bemcal::physics
