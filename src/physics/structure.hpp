/// The hour with refinements that a standard 5R1C lacks: each optional, each off by
/// default.
///
/// - heat capacity of the air node: implicit Euler (its time constant is shorter than a
/// step);
/// - proportional band: power = limit clamp(1/2 + (theta_set - theta_air) / band, 0, 1),
/// solved
///   exactly since theta_air is linear in the power (without a limit: what holds
///   theta_set + band / 2); for cooling with the signs turned;
/// - rooms that differ: their free temperatures lie evenly over room_spread about the
/// zone's, each asks for the same power per kelvin that it lacks, and some may heat while
/// others cool; the zone's power is their mean. Where one unit runs for the room that
/// asks most, each room gets `cooled_together` of that room's cooling at least;
/// - emitter: heating passes a first-order lag (exact over the step), a share of it
/// radiant,
///   split to the surface and mass nodes as the standard splits radiant gains;
/// - second mass: C_2 behind H_2 at the mass node, Crank-Nicolson like the first;
/// - seasons: the power is a share of that for all rooms (season.hpp).
/// Cooling and a negative imposed power leave the air node at once; a positive imposed
/// power is a command to the emitter. With all off it is the standard's hour;
/// simulate.cpp then calls hour.hpp, bit for bit.
#pragma once

#include "physics/hour.hpp"

namespace bemcal::physics {

struct ZoneState {
    double theta_m = 20;     ///< mass [degC]
    double theta_m2 = 20;    ///< second mass [degC]
    double theta_air = 20;   ///< air, where it has a capacity [degC]
    double phi_emitter = 0;  ///< heat leaving the heating emitter now [W]
};

struct StepResult {
    ZoneState after;
    NodeTemperatures theta;  ///< means of the step (theta_m_t at its end)
    double phi_heating = 0;  ///< mean heating power asked of the plant [W], >= 0
    double phi_cooling = 0;  ///< mean cooling power [W], >= 0
    double phi_fan = 0;      ///< of an air system, which then makes the two above [W]
};

/// One step with any of the refinements.
StepResult advance_step(const Network& network, const HourDrive& drive,
                        const Control& control, const ZoneState& before, double dt);

}  // namespace bemcal::physics
