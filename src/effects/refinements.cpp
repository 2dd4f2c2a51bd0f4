/// The table of refinements: what each changes, and its numbers with their priors.
/// Source: ISO 13790's 5R1C, which they refine; ASHRAE Handbook, Fundamentals, for glass
/// by angle; Hay and Davies 1980 for the sky. Priors are judgement. Which of them a
/// building needs is not known here: a loop chooses, or a job says.
#include "effects/refinements.hpp"

#include "effects/decisions.hpp"
#include "effects/sites.hpp"
#include "physics/numbers.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

/// The index of the plane with something of it changed.
template <class Change>
int plane_with(Change change, int index, physics::Building& building) {
    physics::Plane plane = building.planes[static_cast<std::size_t>(index)];
    change(plane);
    return building.plane_index(plane);
}

/// Double clear glass: the polynomial in the angle of incidence is within 0.02 of its
/// solar heat gain coefficients by angle over that at normal incidence (ASHRAE Handbook,
/// Fundamentals: 0.70, 0.67, 0.64, 0.58, 0.45, 0.23 at 0, 40, 50, 60, 70, 80 degrees;
/// 0.60 of light from all sides).
/// A glazing that has a modifier keeps it.
bool glass_by_angle(physics::Building& building) {
    const std::vector<double> modifier = {1, 0, 0.0698, 0, -0.2466, 0, 0.0213};
    const double of_diffuse = 0.60 / 0.70;
    const auto change = [&](physics::Plane& plane) {
        plane.modifier = modifier;
        plane.diffuse_modifier = of_diffuse;
    };
    bool changed = false;
    for (physics::Zone& zone : building.zones)
        for (physics::Window& window : zone.windows) {
            auto& glazing = building.glazings[static_cast<std::size_t>(window.glazing)];
            if (!glazing.angle_modifier.empty() && glazing.angle_modifier != modifier)
                continue;
            glazing.angle_modifier = modifier;
            glazing.incidence_factor = 1;
            window.plane = plane_with(change, window.plane, building);
            changed = true;
        }
    return changed;
}

/// The standard lets the sun on walls and roofs heat the room at once.
bool delay_sun_on_walls(physics::Building& building, double hours) {
    bool changed = false;
    for (physics::Zone& zone : building.zones)
        for (physics::Surface& surface : zone.surfaces) {
            if (!surface.in_sun || surface.boundary != physics::outdoors) continue;
            surface.plane = plane_with([&](auto& plane) { plane.lag_hours = hours; },
                                       surface.plane, building);
            changed = true;
        }
    return changed;
}

/// Models of where the light of the sky comes from differ by several per cent of what a
/// facade gets.
bool sky_of_hay_and_davies(physics::Building& building) {
    const auto change = [](physics::Plane& plane) {
        plane.sky = physics::SkyModel::hay_davies;
    };
    for (physics::Zone& zone : building.zones) {
        for (physics::Window& window : zone.windows)
            window.plane = plane_with(change, window.plane, building);
        for (physics::Surface& surface : zone.surfaces)
            if (surface.in_sun)
                surface.plane = plane_with(change, surface.plane, building);
    }
    return true;
}

/// Air systems that nobody declared, in zones that are cooled and have none.
template <class Fits, class Set>
bool add_air_systems(physics::Building& building, Fits fits, Set set) {
    bool changed = false;
    for (physics::Zone& zone : building.zones) {
        const physics::Thermostat& control = zone.thermostat;
        if (zone.air_system >= 0 || control.imposed ||
            !(control.cooling_capacity.value > 0) || !fits(zone))
            continue;
        physics::AirSystem system;
        system.name = "of " + zone.name;
        system.available = {0};
        system.fan_power = {0};
        set(zone, system);
        zone.air_system = static_cast<int>(building.air_systems.size());
        building.air_systems.push_back(system);
        changed = true;
    }
    return changed;
}

/// The flow from outdoors that a fan brings; -1 = none.
int flow_of_fan(const physics::Zone& zone) {
    const auto place = std::ranges::find_if(zone.flows, is_fan);
    return place == zone.flows.end() ? -1 : static_cast<int>(place - zone.flows.begin());
}

/// By the hours in which they are there [g/(h m2)]; its number sets the size.
physics::Input moisture_of_people(const physics::Zone& zone) {
    physics::Input moisture;
    for (const physics::Load& load : zone.loads)
        if (load.carrier == physics::Carrier::none && load.density.profile >= 0)
            moisture = {1, 0, load.density.profile};
    return moisture;
}

/// Cooled air leaves its water on the coil. The fan's power and hours stay what they are
/// described as.
bool coil_that_dries(physics::Building& building) {
    return add_air_systems(
        building, [](const physics::Zone&) { return true; },
        [](physics::Zone& zone, physics::AirSystem& system) {
            system.variable = false;
            zone.system_flow = flow_of_fan(zone);
            system.people_moisture = moisture_of_people(zone);
        });
}

/// The boundary that has the temperature of what their units supply.
constexpr const char* terminals_air = "supply air of terminals";

/// The least supply air of a zone's terminals: a flow of its own beside the fan's, whose
/// outdoor air its unit mixes now.
void add_terminals(std::size_t z, int system, int boundary, physics::Building& building) {
    using physics::Part;
    physics::Zone& zone = building.zones[z];
    const int fan = flow_of_fan(zone), terminals = static_cast<int>(zone.flows.size());
    physics::AirFlow least;
    least.name = "least supply air";
    least.air_change = {0, 0, zone.flows[physics::row_of(fan)].air_change.profile};
    least.supply = boundary;
    zone.flows.push_back(least);
    zone.system_flow = terminals;
    const auto of_flow = [&](int flow, physics::Input physics::AirFlow::* input) {
        return target_of(building, {Part::flow, static_cast<int>(z), flow},
                         zone.flows[physics::row_of(flow)].*input);
    };
    const auto air =
        target_of(building, {Part::air_system, system},
                  building.air_systems[physics::row_of(system)].outdoor_air_change);
    physics::move_input(building, of_flow(fan, &physics::AirFlow::air_change), air);
    physics::move_input(building, of_flow(fan, &physics::AirFlow::heat_recovery),
                        of_flow(terminals, &physics::AirFlow::heat_recovery));
}

/// Terminals heat again what one unit has cooled for all. The fan that the description
/// has brings the unit's outdoor air; its hours are the unit's.
bool terminals_with_reheat(physics::Building& building) {
    const auto n_before = static_cast<int>(building.air_systems.size());
    const int boundary = static_cast<int>(building.boundaries.size());
    const bool changed = add_air_systems(
        building,
        [](const physics::Zone& zone) {
            return flow_of_fan(zone) >= 0 && !zone.thermostat.heating_capacity.is_off();
        },
        [](physics::Zone& zone, physics::AirSystem& system) {
            const int fan = flow_of_fan(zone);
            system.available = {1, 0,
                                zone.flows[physics::row_of(fan)].air_change.profile};
            system.people_moisture = moisture_of_people(zone);
        });
    if (!changed) return false;
    building.boundaries.push_back(
        {terminals_air, physics::AirSystem{}.supply_temperature});
    for (std::size_t z = 0; z < building.zones.size(); ++z)
        if (building.zones[z].air_system >= n_before)
            add_terminals(z, building.zones[z].air_system, boundary, building);
    return true;
}

/// An air system that is off by its hours runs for the one room that asks, and supplies
/// the others, too.
bool one_unit_for_all(physics::Building& building) {
    bool changed = false;
    for (physics::Zone& zone : building.zones) {
        if (zone.air_system < 0 || zone.thermostat.imposed) continue;
        const physics::Input& available =
            building.air_systems[static_cast<std::size_t>(zone.air_system)].available;
        if (available.profile < 0 || zone.thermostat.cooled_together.is_anything())
            continue;
        zone.thermostat.cooled_together = {0, 1, available.profile};
        if (!zone.thermostat.rooms_differ())
            zone.thermostat.room_spread.profile = available.profile;
        changed = true;
    }
    return changed;
}

/// Whether a thermostat heats: there is a season to be found.
bool is_heated(physics::Building& building) {
    return std::ranges::any_of(building.zones, [](const physics::Zone& zone) {
        const physics::Thermostat& control = zone.thermostat;
        return !zone.radiator && !control.imposed && control.heating_capacity.value > 0;
    });
}

/// Whether a set-point has hours: there is a start.
bool is_set_back(physics::Building& building) {
    return std::ranges::any_of(building.zones, [](const physics::Zone& zone) {
        const physics::Thermostat& control = zone.thermostat;
        return !control.imposed && (control.heating_set_point.profile >= 0 ||
                                    control.cooling_set_point.profile >= 0);
    });
}

/// The long-wave loss that all hours share.
Refinement::Number sky_difference(double mean, double sd) {
    return {"sky_difference", "zone.*.sky_temperature_difference", mean, sd, 0, 28};
}

/// Of a coil that dries, and of people whose water it takes.
constexpr Refinement::Number coil_bypass{
    "coil_bypass", "air_system.*.bypass_factor", 0.1, 0.05, 0, 0.4};
constexpr Refinement::Number water_of_people{
    "moisture_of_people", "air_system.*.people_moisture", 3, 2, 0, 20};

/// An effect with its sign and size free, as the hook's name has it.
Effect following(const char* name, Hook hook, Driver driver, double typical) {
    Effect effect;
    effect.name = name;
    effect.hook = hook;
    effect.driver = driver;
    effect.typical = typical;
    effect.most = 20 * typical;
    effect.least = -effect.most;
    return effect;
}

/// The colder it is outdoors the warmer a unit supplies.
Refinement::Always supply_reset() {
    Effect reset = following("supply temperature per outdoor temperature below 20 degC",
                             Hook::supply_temperature, Driver::theta_e, 0.1);
    reset.shape = {Form::below, 20};
    return {reset, 0.15, 0.15, 0, 0.6};
}

/// Rooms differ by the sun that some of them have.
Refinement::Always spread_by_sun() {
    return {following("room spread per sun that the sunniest room keeps",
                      Hook::room_spread, Driver::sunniest_room, 0.005),
            0.003, 0.003, 0, 0.03};
}

}  // namespace

/// All planes that any structure asks for, in every one of them: they share one drive.
void add_planes_of_refinements(physics::Building& building) {
    std::vector<bool (*)(physics::Building&)> changes;
    for (const Refinement& refinement : refinements())
        if (refinement.change != nullptr) changes.push_back(refinement.change);
    for (std::size_t some = 0; some < std::size_t{1} << changes.size(); ++some) {
        physics::Building changed = building;
        for (std::size_t k = 0; k < changes.size(); ++k)
            if ((some >> k) % 2 == 1) changes[k](changed);
        building.planes = changed.planes;
    }
}

const std::vector<Refinement>& refinements() {
    static const std::vector<Refinement> table = {
        {"surfaces",
         "areas of the mass and of all surfaces, which the standard has as tables",
         {{"mass_area_ratio", "zone.*.mass_area_ratio", 2.5, 0.8, 1.0, 6},
          {"surface_area_ratio", "zone.*.surface_area_ratio", 4.5, 1.2, 1.5, 9}}},
        {"air and thermostat",
         "the air's own heat capacity, and a thermostat with a band",
         {{"air_capacity", "zone.*.air_capacity", 15000, 12000, 1000, 90000},
          {"thermostat_band", "zone.*.proportional_band", 0.8, 0.6, 0.02, 3}}},
        {"rooms that differ",
         "rooms warmer and colder than the mean, each of which asks for itself",
         {{"room_spread", "zone.*.room_spread", 2.5, 1.5, 0.05, 8}},
         {spread_by_sun()},
         nullptr,
         "rooms"},
        {"one unit for all",
         "an air system, off by its hours, that any room turns on for all rooms",
         {{"room_spread", "zone.*.room_spread", 2.5, 1.5, 0.05, 8},
          {"room_spread_off", "zone.*.room_spread.low", 1.5, 1, 0.05, 8}},
         {spread_by_sun()},
         one_unit_for_all,
         "rooms"},
        {"slow start",
         "rooms that reach their set-point late in the first hour after a set-back",
         {},
         {{following("heating set-point in the first hour", Hook::heating_set_point,
                     Driver::plant_start, 0.5),
           -1, 1, -6, 0},
          {following("cooling set-point in the first hour", Hook::cooling_set_point,
                     Driver::plant_start, 0.5),
           1, 1, 0, 6}},
         is_set_back},
        {"emitter",
         "heat that comes late from radiators, in part as radiation",
         {{"emitter_lag", "zone.*.emitter_time_constant", 1500, 1200, 60, 10000},
          {"radiant_share", "zone.*.emitter_radiant_share", 0.4, 0.25, 0, 0.95}}},
        {"gains to air",
         "shares of gains and of sun that heat the air at once",
         {{"gains_air_share", "zone.*.gains_air_share", 0.5, 0.15, 0.05, 0.95},
          {"sun_air_share", "zone.*.sun_air_share", 0.1, 0.05, 0, 0.5}}},
        {"second mass",
         "a slower mass behind the first: ground slabs, cores of walls",
         {{"second_mass_conductance", "zone.*.second_mass_conductance", 2, 2, 0.05, 15},
          {"second_mass_capacity", "zone.*.second_mass_capacity", 200000, 150000, 20000,
           1.2e6}}},
        {"glass by angle",
         "glass lets less through where the sun stands low to it",
         {},
         {},
         glass_by_angle},
        {"sky of Hay and Davies",
         "where the light of the sky comes from, in place of Perez",
         {},
         {},
         sky_of_hay_and_davies},
        {"sun through walls",
         "sun on walls and roofs comes into the room eight hours later",
         {},
         {},
         [](physics::Building& building) { return delay_sun_on_walls(building, 8); }},
        {"sky",
         "the sky's temperature below the air's, the same in all hours",
         {{sky_difference(11, 4)}},
         {},
         nullptr,
         "sky"},
        {"sky by weather",
         "the same, by the clouds and moisture of each hour",
         {{sky_difference(4, 4)}},
         {{following("opaque elements see the sky", Hook::opaque_boundary,
                     Driver::sky_difference, 0.06),
           -0.12, 0.12, -1, 1},
          {following("windows see the sky", Hook::window_boundary, Driver::sky_difference,
                     0.06),
           -0.12, 0.12, -1, 1}},
         nullptr,
         "sky"},
        {"ground of the year",
         "a ground that changes less with the season than its schedule, after ISO 13370",
         {},
         {{following("share of the ground that keeps its yearly mean", Hook::ground,
                     Driver::yearly_mean, 0.5),
           0.5, 0.3, 0, 1}}},
        {"wind in leaks",
         "a share of infiltration that follows the wind",
         {},
         {{following("share of infiltration by wind", Hook::leakage,
                     Driver::relative_wind, 0.3),
           0.3, 0.1, 0, 0.45}}},
        {"coil that dries",
         "moisture that cooled air leaves on the coil",
         {{"coil_temperature", "air_system.*.supply_temperature", 12, 1.5, 6, 18},
          coil_bypass,
          water_of_people},
         {},
         coil_that_dries,
         "air system"},
        {"terminals with reheat",
         "a unit that cools air for all rooms, and terminals that heat it again",
         {{"supply_flow", "air_system.*.design_flow", 15, 5, 5, 40},
          {"least_supply", "zone.*.flow.least supply air.air_change", 1.5, 0.6, 0.1, 5},
          {"supply_temperature", "boundary.supply air of terminals.temperature", 13, 1.5,
           8, 18},
          {"unit_fan", "air_system.*.fan_power", 1, 0.6, 0, 4},
          coil_bypass,
          water_of_people},
         {supply_reset()},
         terminals_with_reheat,
         "air system"},
        {"heating season",
         "heating that stops while the running mean outdoors is above a limit",
         {{"heating_limit", "zone.*.heating_limit", 15, 2, 5, 25}},
         {},
         is_heated},
        {"auxiliaries",
         "electricity of pumps and fans with heat and cold",
         {{"heating_auxiliary", "plant.heating_auxiliary", 0.02, 0.02, 0, 0.3},
          {"cooling_auxiliary", "plant.cooling_auxiliary", 0.02, 0.02, 0, 0.3}}},
        {"COP by weather",
         "cooling that is dearer the warmer it is outdoors",
         {},
         {{following("COP per outdoor temperature", Hook::cooling_cop, Driver::theta_e,
                     0.01),
           -0.01, 0.01, -0.2, 0.2}}},
        {"heating by weather",
         "heating whose efficiency follows the outdoor temperature",
         {},
         {{following("heating efficiency per outdoor temperature",
                     Hook::heating_efficiency, Driver::theta_e, 0.01),
           0.005, 0.01, -0.2, 0.2}}},
        {"sunny rooms",
         "cooling that the rooms with the most sun ask for, before the others need it",
         {},
         {{following("cooling set-point per sun on the sunniest window",
                     Hook::cooling_set_point, Driver::sunniest_window, 0.01),
           -0.002, 0.003, -0.03, 0}}}};
    return table;
}

std::string describe_structure() {
    std::string text =
        "Refinements of the standard's zone, structure = [\"...\"] of a building. A loop\n"
        "tries them; a job may have them in every study. A number of theirs is a parameter\n"
        "with this prior (mean, standard deviation), unless a [[parameter]] leads to it.\n\n";
    for (const Refinement& refinement : refinements()) {
        text += fmt::format("{}\n    {}\n", refinement.name, refinement.what);
        for (const Refinement::Number& number : refinement.numbers)
            text += fmt::format("    {:26} {:g}, {:g}; {}\n", number.name, number.mean,
                                number.sd, number.path);
        for (const Refinement::Always& always : refinement.effects)
            text += fmt::format("    effect {}: {:g}, {:g}\n", always.effect.name,
                                always.mean, always.sd);
    }
    return text;
}

std::string name_of(const std::vector<std::size_t>& structure) {
    std::string name;
    for (const std::size_t index : structure)
        name += (name.empty() ? "" : " + ") + std::string(refinements()[index].name);
    return name.empty() ? "standard" : name;
}

bool are_of_one_kind(std::size_t one, std::size_t other) {
    const std::string_view kind = refinements()[one].kind;
    return one == other || (!kind.empty() && kind == refinements()[other].kind);
}

std::optional<std::vector<std::size_t>> joined_by(
    std::size_t refinement, std::vector<std::size_t> structure,
    const std::vector<std::size_t>& declared) {
    const auto is_rival = [&](std::size_t there) {
        return are_of_one_kind(there, refinement);
    };
    if (std::ranges::find(structure, refinement) != structure.end() ||
        std::ranges::any_of(declared, is_rival))
        return std::nullopt;
    std::erase_if(structure, is_rival);
    structure.push_back(refinement);
    return structure;
}

std::vector<physics::Target> free_targets(
    const physics::Building& building, const char* path,
    const std::vector<physics::Parameter>& taken_by) {
    std::vector<physics::Target> targets = physics::resolve(building, path);
    std::erase_if(targets, [&](const physics::Target& target) {
        return std::ranges::any_of(taken_by, [&](const auto& parameter) {
            return std::ranges::any_of(parameter.targets, [&](const auto& taken) {
                return physics::is_same_number(target, taken);
            });
        });
    });
    return targets;
}

std::pair<double, double> limits_of(double mean, double sd, double least, double most) {
    constexpr double reach = decisions::reach_of_structure;
    return {std::max(least, mean - reach * sd), std::min(most, mean + reach * sd)};
}

std::optional<physics::Parameter> add_number(
    const Refinement::Number& number, const std::vector<physics::Parameter>& others,
    physics::Building& building) {
    auto targets = free_targets(building, number.path, others);
    if (targets.empty()) return std::nullopt;
    std::string name = number.name;
    if (std::ranges::find(others, name, &physics::Parameter::name) != others.end())
        name += " of the structure";
    for (const physics::Target& target : targets)
        physics::number_at(building, target) = number.mean;
    const auto [least, most] =
        limits_of(number.mean, number.sd, number.least, number.most);
    const std::string unit = physics::info_of(building, targets[0]).unit;
    return physics::Parameter{
        name,       unit, least, most, physics::Effect::replace, std::move(targets),
        number.mean};
}

}  // namespace bemcal::effects
