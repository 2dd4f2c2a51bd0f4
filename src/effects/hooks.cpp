/// The hooks' table: name, unit, way into the building, sites, range, and what the
/// grammar tries at each.
/// Ranges and the grammar are judgement, of what makes physical sense. Infiltration and
/// fans are told by name and schedule.
/// How sites are found is left to sites, what is done there to entering.
#include "effects/hooks.hpp"

#include "effects/entering.hpp"
#include "effects/grammar.hpp"
#include "effects/sites.hpp"

#include <iterator>

namespace bemcal::effects {
namespace {

using physics::AirFlow;
using physics::AirSystem;
using physics::ChangeKind;
using physics::OutdoorShift;
using physics::Thermostat;

constexpr unsigned calendar = Follows::calendar, anything = Follows::anything;
constexpr const char* no_heating = "there is no heating by a thermostat and a plant";
constexpr const char* no_cooling = "there is no cooling by a thermostat and a plant";
constexpr const char* no_air_system = "there is no air system";

Range at_least_zero(double most) {
    return {0, most};
}

Range of_recovery(double /*most*/) {
    return {-1, 1};
}

constexpr HookRow rows[] = {
    {.hook = Hook::outdoor_air,
     .name = "outdoor air",
     .unit = "K",
     .enter = change_inputs,
     .shapes_regimes = false,
     .sites =
         [](const Effect&, Sites& sites) {
             sites.of_outdoors(&OutdoorShift::supply);
             sites.of_outdoors(&OutdoorShift::opaque);
             sites.of_outdoors(&OutdoorShift::windows);
         },
     .grammar = {Follows::hours | Follows::seasons | Follows::columns, 4, 1}},
    {.hook = Hook::supply_air,
     .name = "supply air",
     .unit = "K",
     .enter = change_inputs,
     .shapes_regimes = false,
     .sites = [](const Effect&,
                 Sites& sites) { sites.of_outdoors(&OutdoorShift::supply); },
     .grammar = {Follows::hours | Follows::seasons | Follows::temperature, 8, 2}},
    {.hook = Hook::opaque_boundary,
     .name = "opaque boundary",
     .unit = "K",
     .enter = change_inputs,
     .shapes_regimes = false,
     .sites = [](const Effect&,
                 Sites& sites) { sites.of_outdoors(&OutdoorShift::opaque); },
     .grammar = {Follows::hours | Follows::seasons | Follows::wind, 10, 3}},
    {.hook = Hook::window_boundary,
     .name = "window boundary",
     .unit = "K",
     .enter = change_inputs,
     .shapes_regimes = false,
     .sites = [](const Effect&,
                 Sites& sites) { sites.of_outdoors(&OutdoorShift::windows); },
     .grammar = {Follows::seasons | Follows::sun, 6, 2}},
    {.hook = Hook::infiltration,
     .name = "infiltration",
     .unit = "1/h",
     .enter = change_inputs,
     .sites = [](const Effect&, Sites& sites) { sites.of_infiltration(); },
     .grammar = {(anything & ~unsigned{Follows::steps}) | Follows::trend | Follows::sun,
                 4, 0.5}},
    {.hook = Hook::leakage,
     .name = "leakage",
     .unit = "-",
     .enter = change_leaks,
     .sites = [](const Effect&, Sites& sites) { sites.of_leaks(); },
     .lack = "there is no infiltration"},
    {.hook = Hook::ventilation,
     .name = "ventilation",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .sites = [](const Effect&, Sites& sites) { sites.of_ventilation(); },
     .lack = "no air flow follows a schedule",
     .grammar = {anything | Follows::trend | Follows::moisture, 1, 0.3}},
    {.hook = Hook::venting,
     .name = "venting",
     .unit = "1/h",
     .enter = open_windows,
     .range = at_least_zero,
     .sites = [](const Effect&, Sites& sites) { sites.of_openings(); },
     .adds_up = false,
     .first_move = 1.5},
    {.hook = Hook::opaque_conductance,
     .name = "opaque conductance",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .sites = [](const Effect&, Sites& sites) { sites.of_outer_walls(); },
     .grammar = {Follows::seasons | Follows::wind | Follows::trend | Follows::columns,
                 0.6, 0.2}},
    {.hook = Hook::window_conductance,
     .name = "window conductance",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .sites = [](const Effect&, Sites& sites) { sites.of_glazings(); },
     .grammar = {Follows::hours | Follows::seasons | Follows::wind, 0.6, 0.2}},
    {.hook = Hook::neighbour,
     .name = "neighbour",
     .unit = "W/(m2 K)",
     .enter = add_neighbour,
     .range = at_least_zero,
     .adds_up = false,
     .is_per_driver = false,
     .grammar = {Follows::columns, 0.5, 0.1}},
    {.hook = Hook::ground,
     .name = "ground",
     .unit = "-",
     .enter = move_boundaries,
     .shapes_regimes = false,
     .range = at_least_zero,
     .sites = [](const Effect&, Sites& sites) { sites.of_boundaries(); },
     .lack = "no temperature behind elements follows months",
     .adds_up = false},
    {.hook = Hook::second_mass,
     .name = "second mass",
     .unit = "W/(m2 K)",
     .enter = add_second_mass,
     .range = at_least_zero,
     .adds_up = false},
    {.hook = Hook::aperture,
     .name = "aperture",
     .unit = "-",
     .enter = change_windows,
     .kind = ChangeKind::factor,
     .sites = [](const Effect& effect, Sites& sites) { sites.of_windows(effect.facade); },
     .lack = "there is no window on this facade",
     .grammar = {Follows::hours | Follows::seasons | Follows::temperature |
                     Follows::columns,
                 0.9, 0.4}},
    {.hook = Hook::heat_recovery,
     .name = "heat recovery",
     .unit = "-",
     .enter = change_inputs,
     .range = of_recovery,
     .sites =
         [](const Effect&, Sites& sites) {
             sites.of_flows(&AirFlow::heat_recovery, recovers_heat);
         },
     .lack = "there is no ventilation from outdoors that could recover heat"},
    {.hook = Hook::economiser,
     .name = "economiser",
     .unit = "-",
     .enter = change_inputs,
     .shapes_regimes = false,
     .range = at_least_zero,
     .sites = [](const Effect&,
                 Sites& sites) { sites.of_air_systems(&AirSystem::economiser); },
     .lack = no_air_system},
    {.hook = Hook::supply_temperature,
     .name = "supply temperature",
     .unit = "K",
     .enter = change_inputs,
     .shapes_regimes = false,
     .sites = [](const Effect&, Sites& sites) { sites.of_supply_temperatures(); },
     .lack = no_air_system,
     .grammar = {Follows::seasons, 4, 1.5}},
    {.hook = Hook::gains,
     .name = "gains",
     .unit = "W/m2",
     .enter = add_heat,
     .is_use = true,
     .grammar = {anything | Follows::wind | Follows::sun | Follows::trend, 15, 4}},
    {.hook = Hook::loads,
     .name = "loads",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .shapes_regimes = false,
     .sites = [](const Effect&, Sites& sites) { sites.of_loads(heats_a_zone); },
     .lack = "there are no loads that heat a zone",
     .is_use = true,
     .adds_up = false,
     .grammar = {calendar | Follows::temperature | Follows::columns, 1, 0.25}},
    {.hook = Hook::lights,
     .name = "lights",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .shapes_regimes = false,
     .sites = [](const Effect&, Sites& sites) { sites.of_loads(lights_a_zone); },
     .lack = "no load that heats a zone has a name that begins with light",
     .is_use = true,
     .adds_up = false},
    {.hook = Hook::equipment,
     .name = "equipment",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .shapes_regimes = false,
     .sites = [](const Effect&, Sites& sites) { sites.of_loads(equips_a_zone); },
     .lack =
         "no load that heats a zone has a name that begins with equip, plug, device or "
         "appliance",
     .is_use = true,
     .adds_up = false},
    {.hook = Hook::lights_and_equipment,
     .name = "lights and equipment",
     .unit = "W/m2",
     .enter = add_lights_and_equipment,
     .is_use = true,
     .grammar = {anything | Follows::sun | Follows::trend, 15, 4}},
    {.hook = Hook::heating_set_point,
     .name = "heating set-point",
     .unit = "K",
     .enter = change_inputs,
     .sites = [](const Effect&,
                 Sites& sites) { sites.of_heating(&Thermostat::heating_set_point); },
     .lack = no_heating,
     .grammar = {anything | Follows::wind | Follows::sun, 6, 1.5}},
    {.hook = Hook::cooling_set_point,
     .name = "cooling set-point",
     .unit = "K",
     .enter = change_inputs,
     .sites = [](const Effect&,
                 Sites& sites) { sites.of_cooling(&Thermostat::cooling_set_point); },
     .lack = no_cooling,
     .grammar = {anything | Follows::moisture | Follows::trend, 6, 1.5}},
    {.hook = Hook::room_spread,
     .name = "room spread",
     .unit = "K",
     .enter = change_inputs,
     .range = at_least_zero,
     .sites = [](const Effect&, Sites& sites) { sites.of_rooms(); },
     .lack = "no thermostat heats or cools rooms"},
    {.hook = Hook::heating_available,
     .name = "heating available",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .sites = [](const Effect&,
                 Sites& sites) { sites.of_heating(&Thermostat::heating_available); },
     .lack = no_heating},
    {.hook = Hook::cooling_available,
     .name = "cooling available",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .sites = [](const Effect&,
                 Sites& sites) { sites.of_cooling(&Thermostat::cooling_available); },
     .lack = no_cooling},
    {.hook = Hook::operation,
     .name = "operation",
     .unit = "-",
     .enter = move_schedules,
     .kind = ChangeKind::schedule,
     .adds_up = false},
    {.hook = Hook::occupation,
     .name = "occupation",
     .unit = "-",
     .enter = move_schedules_of_loads,
     .kind = ChangeKind::schedule,
     .adds_up = false},
    {.hook = Hook::plant_operation,
     .name = "plant operation",
     .unit = "-",
     .enter = move_schedules_of_plant,
     .kind = ChangeKind::schedule,
     .adds_up = false},
    {.hook = Hook::heating_efficiency,
     .name = "heating efficiency",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .sites = [](const Effect&, Sites& sites) { sites.of_heating_plant(); },
     .lack = no_heating,
     .leaves_loads = true,
     .grammar = {Follows::hours | Follows::seasons | Follows::temperature, 0.5, 0.15}},
    {.hook = Hook::cooling_cop,
     .name = "cooling COP",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .sites = [](const Effect&, Sites& sites) { sites.of_cooling_plant(); },
     .lack = no_cooling,
     .leaves_loads = true,
     .grammar = {Follows::hours | Follows::seasons | Follows::temperature | Follows::wind,
                 0.5, 0.15}},
    {.hook = Hook::meter_addition,
     .name = "meter addition",
     .unit = "W/m2",
     .enter = add_to_meter,
     .is_at_a_meter = true,
     .leaves_loads = true,
     .grammar = {(anything & ~unsigned{Follows::columns}) | Follows::trend, 15, 3}},
    {.hook = Hook::meter_factor,
     .name = "meter factor",
     .unit = "-",
     .enter = change_inputs,
     .kind = ChangeKind::factor,
     .sites = [](const Effect& effect, Sites& sites) { sites.of_meter(effect.meter); },
     .lack = "it needs a meter of energy as its place",
     .is_at_a_meter = true,
     .leaves_loads = true,
     .grammar = {Follows::seasons | Follows::trend, 0.5, 0.15}},
};

constexpr bool rows_stand_in_order() {
    for (std::size_t k = 0; k < std::size(rows); ++k)
        if (rows[k].hook != static_cast<Hook>(k)) return false;
    return true;
}
static_assert(rows_stand_in_order(), "rows have another order than Hook");

}  // namespace

std::span<const HookRow> hook_rows() {
    return rows;
}

const HookRow& row_of(Hook hook) {
    return rows[static_cast<std::size_t>(hook)];
}

}  // namespace bemcal::effects
