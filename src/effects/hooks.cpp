/// Where hooks lie in a building: the inputs that each changes. They are found by their
/// address among the fields of their part, so that no name of a field is repeated here.
/// Plain bookkeeping. Infiltration and fans are told by name and schedule: a flow without
/// a schedule counts as infiltration. Hooks that add a part are left to placement.
#include "effects/hooks.hpp"

#include "effects/drivers.hpp"

#include <algorithm>
#include <stdexcept>

namespace bemcal::effects {
namespace {

using physics::AirFlow;
using physics::Building;
using physics::ChangeKind;
using physics::Input;
using physics::Part;
using physics::Slot;
using physics::Target;
using physics::Zone;
using Targets = std::vector<Target>;

template <class Is>
Target field_where(Target target, Is is) {
    for (const physics::Field& field : physics::fields()) {
        target.field = static_cast<int>(&field - physics::fields().data());
        if (field.part == target.part && is(target)) return target;
    }
    throw std::logic_error("an input that no field names");
}

/// Collects inputs of one building.
class Sites {
  public:
    explicit Sites(Building& building) : building_(building) {}

    void add(Part part, std::size_t index, std::size_t inner, const Input& input) {
        const Target place{part, static_cast<int>(index), static_cast<int>(inner)};
        targets_.push_back(target_of(building_, place, input));
    }

    template <class Pick>
    void of_zones(Pick pick) {
        for (std::size_t z = 0; z < building_.zones.size(); ++z)
            add(Part::zone, z, 0, pick(building_.zones[z]));
    }

    template <class Test>
    void of_flows(Input AirFlow::* input, Test test) {
        for (std::size_t z = 0; z < building_.zones.size(); ++z) {
            std::vector<AirFlow>& flows = building_.zones[z].flows;
            for (std::size_t k = 0; k < flows.size(); ++k)
                if (test(flows[k])) add(Part::flow, z, k, flows[k].*input);
        }
    }

    template <class Test>
    void of_loads(Test test) {
        for (std::size_t z = 0; z < building_.zones.size(); ++z) {
            std::vector<physics::Load>& loads = building_.zones[z].loads;
            for (std::size_t k = 0; k < loads.size(); ++k)
                if (test(loads[k])) add(Part::load, z, k, loads[k].density);
        }
    }

    template <class Test>
    void of_windows(Test test) {
        for (std::size_t z = 0; z < building_.zones.size(); ++z) {
            std::vector<physics::Window>& windows = building_.zones[z].windows;
            for (std::size_t k = 0; k < windows.size(); ++k)
                if (test(windows[k])) add(Part::window, z, k, windows[k].shading);
        }
    }

    Targets targets() && { return std::move(targets_); }

  private:
    Building& building_;
    Targets targets_;
};

bool is_off(const Input& input) {
    return input.value == 0 && (input.profile < 0 || input.low == 0);
}

bool is_infiltration(const AirFlow& flow) {
    return flow.name.find("infiltration") != std::string::npos;
}

bool is_fan(const AirFlow& flow) {
    return flow.air_change.profile >= 0 && !is_infiltration(flow);
}

bool recovers_heat(const AirFlow& flow) {
    const bool ventilates = is_fan(flow) || !is_off(flow.heat_recovery);
    return ventilates && flow.supply == physics::outdoors && !is_infiltration(flow);
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

void add_infiltration(Building& building, Sites& sites) {
    for (std::size_t z = 0; z < building.zones.size(); ++z) {
        const std::size_t flow = infiltration_of(building.zones[z]);
        sites.add(Part::flow, z, flow, building.zones[z].flows[flow].air_change);
    }
}

void add_leakage(Building& building, Sites& sites) {
    for (std::size_t z = 0; z < building.zones.size(); ++z) {
        std::vector<AirFlow>& flows = building.zones[z].flows;
        const auto found = infiltration_among(flows);
        if (found == flows.end() || is_off(found->air_change)) continue;
        sites.add(Part::flow, z, static_cast<std::size_t>(found - flows.begin()),
                  found->air_change);
    }
}

/// Constructions of elements that face outdoors.
void add_outer_walls(Building& building, Sites& sites) {
    std::vector<bool> outer(building.constructions.size());
    for (const Zone& zone : building.zones)
        for (const physics::Surface& surface : zone.surfaces)
            if (surface.boundary == physics::outdoors)
                outer[static_cast<std::size_t>(surface.construction)] = true;
    for (std::size_t k = 0; k < outer.size(); ++k)
        if (outer[k])
            sites.add(Part::construction, k, 0, building.constructions[k].u_value);
}

bool has_heating(const Zone& zone) {
    return !zone.thermostat.imposed && !is_off(zone.thermostat.heating_capacity);
}

bool has_cooling(const Zone& zone) {
    return !zone.thermostat.imposed && !is_off(zone.thermostat.cooling_capacity);
}

/// A thermostat's input in the zones that have what it controls.
template <class Has>
void add_thermostat(Building& building, Input physics::Thermostat::* input, Has has,
                    Sites& sites) {
    for (std::size_t z = 0; z < building.zones.size(); ++z)
        if (has(building.zones[z]))
            sites.add(Part::zone, z, 0, building.zones[z].thermostat.*input);
}

void add_outdoors(Input physics::OutdoorShift::* input, Sites& sites) {
    sites.of_zones([&](Zone& zone) -> const Input& { return zone.outdoor_shift.*input; });
}

/// Outdoor temperatures, air and the envelope.
void add_envelope(const Effect& effect, Building& building, Sites& sites) {
    using physics::OutdoorShift;
    const bool all = effect.hook == Hook::outdoor_air;
    if (all || effect.hook == Hook::supply_air)
        add_outdoors(&OutdoorShift::supply, sites);
    if (all || effect.hook == Hook::opaque_boundary)
        add_outdoors(&OutdoorShift::opaque, sites);
    if (all || effect.hook == Hook::window_boundary)
        add_outdoors(&OutdoorShift::windows, sites);
    if (effect.hook == Hook::opaque_conductance) add_outer_walls(building, sites);
    if (effect.hook == Hook::window_conductance)
        for (std::size_t k = 0; k < building.glazings.size(); ++k)
            sites.add(Part::glazing, k, 0, building.glazings[k].u_value);
    if (effect.hook == Hook::aperture)
        sites.of_windows([&](const physics::Window& window) {
            return effect.place < 0 || same_facade(building, window.plane, effect.place);
        });
}

void add_air(const Effect& effect, Building& building, Sites& sites) {
    if (effect.hook == Hook::infiltration) add_infiltration(building, sites);
    if (effect.hook == Hook::leakage) add_leakage(building, sites);
    if (effect.hook == Hook::ventilation) sites.of_flows(&AirFlow::air_change, is_fan);
    if (effect.hook == Hook::heat_recovery)
        sites.of_flows(&AirFlow::heat_recovery, recovers_heat);
    if (effect.hook == Hook::venting)
        sites.of_zones(
            [](Zone& zone) -> const Input& { return zone.venting.air_change; });
}

void add_control(const Effect& effect, Building& building, Sites& sites) {
    using physics::Thermostat;
    switch (effect.hook) {
        case Hook::heating_set_point:
            return add_thermostat(building, &Thermostat::heating_set_point, has_heating,
                                  sites);
        case Hook::cooling_set_point:
            return add_thermostat(building, &Thermostat::cooling_set_point, has_cooling,
                                  sites);
        case Hook::heating_available:
            return add_thermostat(building, &Thermostat::heating_available, has_heating,
                                  sites);
        case Hook::cooling_available:
            return add_thermostat(building, &Thermostat::cooling_available, has_cooling,
                                  sites);
        default:
            return;
    }
}

void add_plant(const Effect& effect, Building& building, Sites& sites) {
    const auto any = [&](auto has) {
        return std::any_of(building.zones.begin(), building.zones.end(), has);
    };
    physics::Plant& plant = building.plant;
    if (effect.hook == Hook::heating_efficiency && any(has_heating) &&
        plant.heating_carrier != physics::Carrier::none)
        sites.add(Part::plant, 0, 0, plant.heating_efficiency);
    if (effect.hook == Hook::cooling_cop && any(has_cooling) &&
        plant.cooling_carrier != physics::Carrier::none)
        sites.add(Part::plant, 0, 0, plant.cooling_cop);
    const auto meter = static_cast<std::size_t>(effect.place);
    if (effect.hook == Hook::meter_factor && effect.place > 0 &&
        meter < building.meter_factor.size())
        sites.add(Part::meter, meter, 0, building.meter_factor[meter]);
}

/// What a building lacks where a hook has no site.
const char* lack_of(Hook hook) {
    switch (hook) {
        case Hook::ventilation:
            return "no air flow follows a schedule";
        case Hook::heat_recovery:
            return "there is no ventilation from outdoors that could recover heat";
        case Hook::aperture:
            return "there is no window on this facade";
        case Hook::leakage:
            return "there is no infiltration";
        case Hook::loads:
            return "there are no loads that heat a zone";
        case Hook::heating_set_point:
        case Hook::heating_available:
        case Hook::heating_efficiency:
            return "there is no heating by a thermostat and a plant";
        case Hook::cooling_set_point:
        case Hook::cooling_available:
        case Hook::cooling_cop:
            return "there is no cooling by a thermostat and a plant";
        case Hook::meter_factor:
            return "it needs a meter of energy as its place";
        default:
            return "the building has nothing that it could change";
    }
}

}  // namespace

Target target_of(Building& building, Target part, const Input& input) {
    part.slot = Slot::change;
    return field_where(part, [&](const Target& target) {
        return physics::input_at(building, target) == &input;
    });
}

Target target_of(Building& building, Target part, const double& number) {
    part.slot = Slot::value;
    return field_where(part, [&](const Target& target) {
        return &physics::number_at(building, target) == &number;
    });
}

ChangeKind kind_of(Hook hook) {
    switch (hook) {
        case Hook::ventilation:
        case Hook::opaque_conductance:
        case Hook::window_conductance:
        case Hook::aperture:
        case Hook::loads:
        case Hook::heating_available:
        case Hook::cooling_available:
        case Hook::heating_efficiency:
        case Hook::cooling_cop:
        case Hook::meter_factor:
            return ChangeKind::factor;
        case Hook::operation:
        case Hook::occupation:
        case Hook::plant_operation:
            return ChangeKind::schedule;
        default:
            return ChangeKind::shift;
    }
}

bool shapes_regimes(Hook hook) {
    constexpr Hook linear[] = {Hook::outdoor_air,     Hook::supply_air,
                               Hook::opaque_boundary, Hook::window_boundary,
                               Hook::neighbour,       Hook::gains,
                               Hook::loads,           Hook::lights_and_equipment,
                               Hook::meter_addition};
    return std::find(std::begin(linear), std::end(linear), hook) == std::end(linear);
}

Targets sites_of(const Effect& effect, Building& building) {
    Sites sites(building);
    add_envelope(effect, building, sites);
    add_air(effect, building, sites);
    add_control(effect, building, sites);
    add_plant(effect, building, sites);
    if (effect.hook == Hook::loads)
        sites.of_loads([](const physics::Load& load) { return load.heat_fraction > 0; });
    Targets targets = std::move(sites).targets();
    if (targets.empty()) throw std::invalid_argument(lack_of(effect.hook));
    return targets;
}

Targets scheduled_sites(Building& building, Scheduled which) {
    using physics::Thermostat;
    Sites sites(building);
    if (which == Scheduled::loads)
        sites.of_loads([](const physics::Load&) { return true; });
    else {
        for (Input Thermostat::* input :
             {&Thermostat::heating_set_point, &Thermostat::cooling_set_point,
              &Thermostat::heating_capacity, &Thermostat::cooling_capacity,
              &Thermostat::heating_available, &Thermostat::cooling_available})
            sites.of_zones(
                [&](Zone& zone) -> const Input& { return zone.thermostat.*input; });
        for (Input AirFlow::* input : {&AirFlow::air_change, &AirFlow::heat_recovery})
            sites.of_flows(input, [](const AirFlow&) { return true; });
        sites.of_zones(
            [](Zone& zone) -> const Input& { return zone.venting.air_change; });
    }
    Targets targets = std::move(sites).targets();
    std::erase_if(targets, [&](const Target& target) {
        return physics::input_at(building, target)->profile < 0;
    });
    return targets;
}

}  // namespace bemcal::effects
