/// Ways in which effects enter a building: what a hook's row can name.
#pragma once

#include "effects/hook_row.hpp"

namespace bemcal::effects {

/// Changes the inputs at its sites, all by the same profile.
void change_inputs(Placer&, const HookRow&, const Effect&);
/// The same of windows; those of every facade each by its own sun.
void change_windows(Placer&, const HookRow&, const Effect&);
/// Of each zone's declared infiltration, whatever a parameter makes of it.
void change_leaks(Placer&, const HookRow&, const Effect&);
void move_boundaries(Placer&, const HookRow&, const Effect&);
/// Openings that follow the room and open above a temperature.
void open_windows(Placer&, const HookRow&, const Effect&);

/// Schedules as on another day or at another hour.
void move_schedules(Placer&, const HookRow&, const Effect&);
void move_schedules_of_loads(Placer&, const HookRow&, const Effect&);
void move_schedules_of_plant(Placer&, const HookRow&, const Effect&);

/// A load in every zone: heat that no meter sees, electricity that becomes heat, or what
/// the effect's meter sees without heat.
void add_heat(Placer&, const HookRow&, const Effect&);
void add_lights_and_equipment(Placer&, const HookRow&, const Effect&);
void add_to_meter(Placer&, const HookRow&, const Effect&);

/// A conductance to another temperature.
void add_neighbour(Placer&, const HookRow&, const Effect&);
/// A second mass of twice the first one's capacity.
void add_second_mass(Placer&, const HookRow&, const Effect&);

}  // namespace bemcal::effects
