/// Where hooks lie in a building: the inputs that each changes. They are found by their
/// address among the fields of their part, so that no name of a field is repeated here.
/// Plain bookkeeping. Infiltration and fans are told by name and schedule: a flow without
/// a schedule counts as infiltration. Hooks that add a part are left to entering.
#include "effects/sites.hpp"

#include "base/lower_case.hpp"
#include "physics/air_hour.hpp"

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

namespace bemcal::effects {
namespace {

using physics::AirFlow;
using physics::Input;
using physics::Part;
using physics::Slot;
using physics::Target;
using physics::Thermostat;
using physics::Zone;

template <class Is>
Target field_where(Target target, Is is) {
    for (const physics::Field& field : physics::fields()) {
        target.field = static_cast<int>(&field - physics::fields().data());
        if (field.part == target.part && is(target)) return target;
    }
    throw std::logic_error("an input that no field names");
}

bool is_infiltration(const AirFlow& flow) {
    return flow.name.find("infiltration") != std::string::npos;
}

/// The zone's flow that is infiltration; end where there is none.
std::vector<AirFlow>::iterator infiltration_among(std::vector<AirFlow>& flows) {
    const auto from_outdoors = [](const AirFlow& flow) {
        return flow.supply == physics::outdoors;
    };
    const auto found = std::find_if(flows.begin(), flows.end(), [&](const AirFlow& flow) {
        return from_outdoors(flow) && is_infiltration(flow);
    });
    if (found != flows.end()) return found;
    return std::find_if(flows.begin(), flows.end(), [&](const AirFlow& flow) {
        return from_outdoors(flow) && flow.air_change.profile < 0;
    });
}

/// That flow, made where there is none.
std::size_t infiltration_of(Zone& zone) {
    std::vector<AirFlow>& flows = zone.flows;
    const auto found = infiltration_among(flows);
    if (found == flows.end()) {
        AirFlow added;
        added.name = "infiltration";
        flows.push_back(added);
        return flows.size() - 1;
    }
    return static_cast<std::size_t>(found - flows.begin());
}

bool has_heating(const Zone& zone) {
    return !zone.thermostat.imposed && !zone.thermostat.heating_capacity.is_off();
}

bool has_cooling(const Zone& zone) {
    return !zone.thermostat.imposed && !zone.thermostat.cooling_capacity.is_off();
}

}  // namespace

bool is_fan(const AirFlow& flow) {
    return flow.supply == physics::outdoors && flow.air_change.profile >= 0 &&
           !is_infiltration(flow);
}

bool recovers_heat(const AirFlow& flow) {
    const bool ventilates = is_fan(flow) || !flow.heat_recovery.is_off();
    return ventilates && flow.supply == physics::outdoors && !is_infiltration(flow);
}

bool heats_a_zone(const physics::Load& load) {
    return load.heat_fraction > 0;
}

namespace {

bool begins_with_one_of(const std::string& name,
                        std::initializer_list<std::string_view> words) {
    return std::ranges::any_of(
        words, [&](std::string_view word) { return name.starts_with(word); });
}

}  // namespace

bool lights_a_zone(const physics::Load& load) {
    const std::string name = lower_case(load.name);
    return heats_a_zone(load) && name.starts_with("light") &&
           name.find("equip") == std::string::npos;
}

bool equips_a_zone(const physics::Load& load) {
    const std::string name = lower_case(load.name);
    return heats_a_zone(load) &&
           begins_with_one_of(name, {"equip", "plug", "device", "appliance"}) &&
           name.find("light") == std::string::npos;
}

bool same_facade(const physics::Building& building, int plane, int other) {
    const physics::Plane& a = building.planes[static_cast<std::size_t>(plane)];
    const physics::Plane& b = building.planes[static_cast<std::size_t>(other)];
    return a.tilt == b.tilt && a.azimuth == b.azimuth;
}

Target target_of(physics::Building& building, Target part, const Input& input) {
    part.slot = Slot::change;
    return field_where(part, [&](const Target& target) {
        return physics::input_at(building, target) == &input;
    });
}

Target target_of(physics::Building& building, Target part, const double& number) {
    part.slot = Slot::value;
    return field_where(part, [&](const Target& target) {
        return &physics::number_at(building, target) == &number;
    });
}

void Sites::add(Part part, std::size_t index, std::size_t inner, const Input& input) {
    const Target place{part, static_cast<int>(index), static_cast<int>(inner)};
    targets_.push_back(target_of(building_, place, input));
}

template <class Pick>
void Sites::of_zones(Pick pick) {
    for (std::size_t z = 0; z < building_.zones.size(); ++z)
        add(Part::zone, z, 0, pick(building_.zones[z]));
}

template <class Has>
void Sites::of_thermostats(Input Thermostat::* input, Has has) {
    for (std::size_t z = 0; z < building_.zones.size(); ++z)
        if (has(building_.zones[z]))
            add(Part::zone, z, 0, building_.zones[z].thermostat.*input);
}

void Sites::of_outdoors(Input physics::OutdoorShift::* input) {
    of_zones([&](Zone& zone) -> const Input& { return zone.outdoor_shift.*input; });
}

void Sites::of_infiltration() {
    for (std::size_t z = 0; z < building_.zones.size(); ++z) {
        const std::size_t flow = infiltration_of(building_.zones[z]);
        add(Part::flow, z, flow, building_.zones[z].flows[flow].air_change);
    }
}

void Sites::of_leaks() {
    for (std::size_t z = 0; z < building_.zones.size(); ++z) {
        std::vector<AirFlow>& flows = building_.zones[z].flows;
        const auto found = infiltration_among(flows);
        if (found == flows.end() || found->air_change.is_off()) continue;
        add(Part::flow, z, static_cast<std::size_t>(found - flows.begin()),
            found->air_change);
    }
}

void Sites::of_boundaries() {
    for (std::size_t b = 0; b < building_.boundaries.size(); ++b)
        if (building_.boundaries[b].temperature.profile >= 0 && !is_supply(b))
            add(Part::boundary, b, 0, building_.boundaries[b].temperature);
}

void Sites::of_flows(Input AirFlow::* input, bool (*is_one)(const AirFlow&)) {
    for (std::size_t z = 0; z < building_.zones.size(); ++z) {
        std::vector<AirFlow>& flows = building_.zones[z].flows;
        for (std::size_t k = 0; k < flows.size(); ++k)
            if (is_one(flows[k])) add(Part::flow, z, k, flows[k].*input);
    }
}

void Sites::of_openings() {
    of_zones([](Zone& zone) -> const Input& { return zone.venting.air_change; });
}

void Sites::of_outer_walls() {
    std::vector<bool> outer(building_.constructions.size());
    for (const Zone& zone : building_.zones)
        for (const physics::Surface& surface : zone.surfaces)
            if (surface.boundary == physics::outdoors)
                outer[static_cast<std::size_t>(surface.construction)] = true;
    for (std::size_t k = 0; k < outer.size(); ++k)
        if (outer[k]) add(Part::construction, k, 0, building_.constructions[k].u_value);
}

void Sites::of_glazings() {
    for (std::size_t k = 0; k < building_.glazings.size(); ++k)
        add(Part::glazing, k, 0, building_.glazings[k].u_value);
}

void Sites::of_windows(std::optional<int> facade) {
    for (std::size_t z = 0; z < building_.zones.size(); ++z) {
        std::vector<physics::Window>& windows = building_.zones[z].windows;
        for (std::size_t k = 0; k < windows.size(); ++k)
            if (!facade || same_facade(building_, windows[k].plane, *facade))
                add(Part::window, z, k, windows[k].shading);
    }
}

void Sites::of_loads(bool (*is_one)(const physics::Load&)) {
    for (std::size_t z = 0; z < building_.zones.size(); ++z) {
        std::vector<physics::Load>& loads = building_.zones[z].loads;
        for (std::size_t k = 0; k < loads.size(); ++k)
            if (is_one(loads[k])) add(Part::load, z, k, loads[k].density);
    }
}

void Sites::of_heating(Input Thermostat::* input) {
    of_thermostats(input, has_heating);
}

void Sites::of_cooling(Input Thermostat::* input) {
    of_thermostats(input, has_cooling);
}

void Sites::of_rooms() {
    of_thermostats(&Thermostat::room_spread, [](const Zone& zone) {
        return has_heating(zone) || has_cooling(zone);
    });
}

void Sites::of_air_systems(Input physics::AirSystem::* input) {
    for (std::size_t k = 0; k < building_.air_systems.size(); ++k)
        if (std::ranges::find(building_.zones, static_cast<int>(k), &Zone::air_system) !=
            building_.zones.end())
            add(Part::air_system, k, 0, building_.air_systems[k].*input);
}

bool Sites::is_supply(std::size_t boundary) const {
    return std::ranges::any_of(building_.zones, [&](const Zone& zone) {
        return physics::supply_boundary(zone) == static_cast<int>(boundary);
    });
}

void Sites::of_ventilation() {
    of_flows(&AirFlow::air_change, is_fan);
    for (std::size_t k = 0; k < building_.air_systems.size(); ++k)
        if (const auto& system = building_.air_systems[k];
            !system.outdoor_air_change.is_off())
            add(Part::air_system, k, 0, system.outdoor_air_change);
}

void Sites::of_supply_temperatures() {
    for (std::size_t b = 0; b < building_.boundaries.size(); ++b)
        if (is_supply(b)) add(Part::boundary, b, 0, building_.boundaries[b].temperature);
    for (std::size_t k = 0; k < building_.air_systems.size(); ++k)
        if (std::ranges::any_of(building_.zones, [k](const Zone& zone) {
                return zone.air_system == static_cast<int>(k) &&
                       physics::supply_boundary(zone) == physics::outdoors;
            }))
            add(Part::air_system, k, 0, building_.air_systems[k].supply_temperature);
}

void Sites::of_heating_plant() {
    if (building_.plant.heating_carrier != physics::Carrier::none &&
        std::ranges::any_of(building_.zones, has_heating))
        add(Part::plant, 0, 0, building_.plant.heating_efficiency);
}

void Sites::of_cooling_plant() {
    if (building_.plant.cooling_carrier != physics::Carrier::none &&
        std::ranges::any_of(building_.zones, has_cooling))
        add(Part::plant, 0, 0, building_.plant.cooling_cop);
}

void Sites::of_meter(std::optional<physics::Quantity> meter) {
    if (!meter || physics::is_temperature(*meter)) return;
    const auto row = static_cast<std::size_t>(*meter);
    add(Part::meter, row, 0, building_.meter_factor[row]);
}

void Sites::of_scheduled_loads() {
    of_loads([](const physics::Load&) { return true; });
    keep_scheduled();
}

void Sites::of_scheduled_plant() {
    for (Input Thermostat::* input :
         {&Thermostat::heating_set_point, &Thermostat::cooling_set_point,
          &Thermostat::heating_capacity, &Thermostat::cooling_capacity,
          &Thermostat::heating_available, &Thermostat::cooling_available})
        of_thermostats(input, [](const Zone&) { return true; });
    for (Input AirFlow::* input : {&AirFlow::air_change, &AirFlow::heat_recovery})
        of_flows(input, [](const AirFlow&) { return true; });
    of_openings();
    for (Input physics::AirSystem::* input :
         {&physics::AirSystem::available, &physics::AirSystem::supply_temperature,
          &physics::AirSystem::economiser, &physics::AirSystem::outdoor_air_change})
        of_air_systems(input);
    keep_scheduled();
}

void Sites::keep_scheduled() {
    std::erase_if(targets_, [&](const Target& target) {
        return physics::input_at(building_, target)->profile < 0;
    });
}

}  // namespace bemcal::effects
