/// Reads constructions, glazings, boundaries, zones and plant. Numbers come from
/// `fields()`, so that a number of a building is declared once.
/// Source: ISO 13790, Table 12, for the classes of heat capacity.
/// Links are in `read_links`, uncertain numbers in `read_parameters`; `check_building`
/// asks whether the method can simulate it.
#include "description/building_readers.hpp"
#include "input/suggest.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using physics::Building;
using physics::Field;
using physics::Input;
using physics::Part;
using physics::Profile;
using physics::Zone;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& list) {
    std::vector<std::string> names;
    names.reserve(list.size());
    for (const Named& item : list) names.push_back(item.name);
    return names;
}

/// Index of the thing that the key names; the error lists what there is.
template <class Named>
int index_of(const schema::Section& section, const char* key,
             const std::vector<Named>& list, const char* heading) {
    const std::string name = section.text(key);
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].name == name) return static_cast<int>(i);
    if (section.is_lost(name)) throw schema::Follows();
    if (list.empty())
        section.fail_value(
            key, fmt::format("there is no {} of this name, nor any other", heading));
    section.fail_value(key, fmt::format("there is no {} of this name{}", heading,
                                        input::suggestion(name, names_of(list))));
}

/// Reads the numbers of parts, with the profiles that they may follow.
class NumberReader {
  public:
    explicit NumberReader(const std::vector<Profile>& profiles) : profiles_(profiles) {}

    /// Every field of the part: as written, or its default. One may be left out, since it
    /// follows from others.
    void read(const schema::Section& section, Part part, void* object,
              std::string_view left_out = "") const {
        for (const Field& field : physics::fields()) {
            if (field.part != part || field.key == left_out) continue;
            if (field.constant != nullptr)
                *field.constant(object) = section.number(field.key);
            else
                *field.input(object) = read_input(section, field);
        }
    }

  private:
    Input read_input(const schema::Section& section, const Field& field) const {
        const schema::Key& row = *schema::find_key(section.schema(), field.key);
        if (!section.has(field.key) && row.fallback != nullptr)
            return {field.fallback, 0, -1};
        const schema::Node& node = section.node(field.key);
        if (node.kind != schema::Node::Kind::table) {
            const std::string where = section.where(field.key);
            return {schema::checked_number(node, row, where), 0, -1};
        }
        const schema::Section parts = section.table(field.key, "input");
        return parts.has("series") ? read_series(parts) : read_scheduled(parts, row);
    }

    Input read_series(const schema::Section& parts) const {
        for (const char* key : {"schedule", "low"})
            if (parts.has(key))
                parts.fail(key, "has no place beside series; remove one of them");
        const int profile = profile_of(parts, "series");
        if (profile >= 0 && !profiles_[static_cast<std::size_t>(profile)].is_series)
            parts.fail_value("series",
                             "is a schedule; write schedule in place of series");
        return {parts.has("value") ? parts.number("value") : 1, 0, profile};
    }

    Input read_scheduled(const schema::Section& parts, const schema::Key& row) const {
        Input input;
        const auto checked = [&](const char* key) {
            return schema::checked_number(parts.node(key), row, parts.where(key));
        };
        input.value = checked("value");
        if (!parts.has("schedule")) {
            if (parts.has("low"))
                parts.fail("low",
                           "has no effect without schedule; add schedule = \"name\"");
            return input;
        }
        if (parts.has("low")) input.low = checked("low");
        input.profile = profile_of(parts, "schedule");
        if (input.profile >= 0 &&
            profiles_[static_cast<std::size_t>(input.profile)].is_series)
            parts.fail_value("schedule",
                             "is a series; write series in place of schedule");
        return input;
    }

    /// Of a schedule or series; -1 of one that could not be read, so that the others of
    /// the section are.
    int profile_of(const schema::Section& parts, const char* key) const {
        const std::string name = parts.text(key);
        const bool is_there =
            std::ranges::find(profiles_, name, &Profile::name) != profiles_.end();
        if (!is_there && parts.is_lost(name)) return -1;
        return index_of(parts, key, profiles_, fmt::format("[[{}]]", key).c_str());
    }

    const std::vector<Profile>& profiles_;
};

class BuildingReader {
  public:
    BuildingReader(const Sources& sources, const std::vector<Profile>& profiles)
        : sources_(sources), numbers_(profiles) {}

    Building read() {
        read_envelope();
        if (!sources_.has("zone")) sources_.own.node("zone");
        if (sources_.with("zone").list_of_tables("zone").empty())
            sources_.own.fail("zone", "is empty; expected at least one [[zone]]");
        sources_.each("zone", [&](const auto& section) { read_zone(section); });
        sources_.each("zone", [&](const auto& section) { read_couplings(section); });
        sources_.each("air_system",
                      [&](const auto& section) { read_air_system(section); });
        sources_.attempt([&] { read_plant(); }, {"plant"});
        return std::move(building_);
    }

  private:
    template <class Item>
    void add_named(const schema::Section& section, Item item, std::vector<Item>& list) {
        for (const Item& other : list)
            if (other.name == item.name)
                section.fail_value(
                    "name", fmt::format("another {} has this name", section.schema()));
        if (item.name.find_first_of(".*") != std::string::npos)
            section.fail_value("name",
                               "has a dot or a star, which mean something in a "
                               "parameter's target; expected another name");
        list.push_back(std::move(item));
    }

    /// The name as written, or "surface_3".
    template <class Item>
    std::string name_or_number(const schema::Section& section,
                               const std::vector<Item>& list, const char* kind) {
        return section.has("name") ? section.text("name")
                                   : fmt::format("{}_{}", kind, list.size() + 1);
    }

    void read_envelope() {
        sources_.each("construction", [&](const schema::Section& section) {
            physics::Construction construction;
            construction.name = section.text("name");
            read_layers(section, construction);
            numbers_.read(section, Part::construction, &construction,
                          construction.layers.empty() ? "" : "u_value");
            add_named(section, std::move(construction), building_.constructions);
        });
        sources_.each("glazing", [&](const schema::Section& section) {
            physics::Glazing glazing;
            glazing.name = section.text("name");
            numbers_.read(section, Part::glazing, &glazing);
            glazing.angle_modifier = section.numbers("angle_modifier");
            if (!glazing.angle_modifier.empty() && !section.has("incidence_factor"))
                glazing.incidence_factor = 1;
            add_named(section, std::move(glazing), building_.glazings);
        });
        sources_.each("boundary", [&](const schema::Section& section) {
            physics::Boundary boundary;
            boundary.name = section.text("name");
            numbers_.read(section, Part::boundary, &boundary);
            add_named(section, std::move(boundary), building_.boundaries);
        });
    }

    /// Each of the parts of a section; it cannot be read without one of them.
    template <class Read>
    static void each_part(const schema::Section& section, const char* key,
                          const char* schema, Read read) {
        if (!section.each(key, schema, read)) throw schema::Follows();
    }

    void read_layers(const schema::Section& section,
                     physics::Construction& construction) {
        each_part(section, "layer", "construction.layer", [&](const auto& part) {
            physics::Layer layer;
            layer.name = name_or_number(part, construction.layers, "layer");
            numbers_.read(part, Part::layer, &layer);
            add_named(part, std::move(layer), construction.layers);
        });
        if (!construction.layers.empty() && section.has("u_value"))
            section.fail("u_value", "follows from the layers; remove it, or them");
    }

    int boundary_of(const schema::Section& section, const char* key) {
        if (section.text(key) == "outdoors") return physics::outdoors;
        return index_of(section, key, building_.boundaries, "[[boundary]]");
    }

    int plane_of(const schema::Section& section, const std::vector<double>& modifier) {
        const double tilt = section.number("tilt");
        if (!section.has("azimuth") && tilt > 0 && tilt < 180)
            section.fail("azimuth",
                         "is missing; expected degrees clockwise from north (0 = "
                         "north, 90 = east, 180 = south)");
        double azimuth = section.has("azimuth") ? section.number("azimuth") : 0;
        azimuth = std::fmod(azimuth + 360, 360);
        return building_.plane_index({radians(tilt), radians(azimuth), modifier});
    }

    void read_surface(const schema::Section& section, Zone& zone) {
        physics::Surface surface;
        surface.name = name_or_number(section, zone.surfaces, "surface");
        surface.construction = index_of(section, "construction", building_.constructions,
                                        "[[construction]]");
        surface.boundary = boundary_of(section, "boundary");
        surface.in_sun = section.has("in_sun") ? section.flag("in_sun")
                                               : surface.boundary == physics::outdoors;
        if (surface.in_sun)
            surface.plane = plane_of(section, {});
        else  // it may say how it lies, but nothing follows
            for (const char* key : {"azimuth", "tilt"})
                if (section.has(key)) section.number(key);
        numbers_.read(section, Part::surface, &surface);
        check_area(section, surface.area);
        add_named(section, std::move(surface), zone.surfaces);
    }

    void read_window(const schema::Section& section, Zone& zone) {
        physics::Window window;
        window.name = name_or_number(section, zone.windows, "window");
        window.glazing = index_of(section, "glazing", building_.glazings, "[[glazing]]");
        window.plane = plane_of(
            section,
            building_.glazings[static_cast<std::size_t>(window.glazing)].angle_modifier);
        numbers_.read(section, Part::window, &window);
        check_area(section, window.area);
        add_named(section, std::move(window), zone.windows);
    }

    static void check_area(const schema::Section& section, double area) {
        if (area <= 0)
            section.fail_value("area",
                               "expected more than 0 m2; leave the element out if it "
                               "is not there");
    }

    void read_flow(const schema::Section& section, Zone& zone) {
        physics::AirFlow flow;
        flow.name = section.text("name");
        flow.supply = boundary_of(section, "supply");
        numbers_.read(section, Part::flow, &flow);
        if (flow.supply != physics::outdoors && section.has("heat_recovery"))
            section.fail("heat_recovery",
                         "works on outdoor air only; remove it, or supply");
        add_named(section, std::move(flow), zone.flows);
    }

    void read_load(const schema::Section& section, Zone& zone) {
        physics::Load load;
        load.name = section.text("name");
        load.carrier = section.choice_as<physics::Carrier>("carrier");
        numbers_.read(section, Part::load, &load);
        add_named(section, std::move(load), zone.loads);
    }

    void read_zone(const schema::Section& section) {
        Zone zone;
        zone.name = section.text("name");
        numbers_.read(section, Part::zone, &zone);
        if (section.has("radiator")) read_radiator(section, zone);
        zone.thermostat.imposed = section.has("imposed_power");
        for (const char* key :
             {"heating_set_point", "cooling_set_point", "heating_limit", "cooling_limit"})
            if (zone.thermostat.imposed && section.has(key))
                section.fail(key,
                             "has no effect beside imposed_power; remove one of them");
        read_parts(section, zone);
        if (section.has("class")) read_class(section, zone);
        add_named(section, std::move(zone), building_.zones);
    }

    /// All of them, whatever is wrong with one.
    void read_parts(const schema::Section& section, Zone& zone) {
        bool is_whole = section.each("surface", "zone.surface",
                                     [&](const auto& part) { read_surface(part, zone); });
        is_whole &= section.each("window", "zone.window",
                                 [&](const auto& part) { read_window(part, zone); });
        is_whole &= section.each("flow", "zone.flow",
                                 [&](const auto& part) { read_flow(part, zone); });
        is_whole &= section.each("load", "zone.load",
                                 [&](const auto& part) { read_load(part, zone); });
        if (!is_whole) throw schema::Follows();
    }

    void read_radiator(const schema::Section& section, Zone& zone) {
        for (const char* key : {"heating_set_point", "heating_capacity",
                                "heating_available", "heating_limit", "imposed_power",
                                "emitter_time_constant", "emitter_radiant_share"})
            if (section.has(key))
                section.fail(key,
                             "has no effect beside [zone.radiator]; remove one of them");
        const schema::Section part = section.table("radiator", "zone.radiator");
        physics::ZoneRadiator& radiator = zone.radiator.emplace();
        numbers_.read(part, Part::radiator, &radiator);
        radiator.radiator.n_elements = static_cast<int>(part.integer("elements"));
        const bool measured = part.has("supply_temperature");
        if (measured && !part.has("supply_measured")) radiator.measured.value = 1;
        for (const char* key : {"supply_measured", "flow"})
            if (!measured && part.has(key))
                part.fail(key,
                          "has no effect without supply_temperature; add that, or "
                          "remove this");
    }

    void check_layers(const schema::Section& section, const Zone& zone) const {
        for (const char* key : {"heat_capacity", "mass_area_ratio"})
            if (section.has(key))
                section.fail(key, "follows from the layers; remove it, or class");
        for (const physics::Surface& surface : zone.surfaces)
            if (!building_.constructions[static_cast<std::size_t>(surface.construction)]
                     .layers.empty())
                return;
        section.fail_value("class",
                           "no surface of the zone has layers; expected a construction "
                           "with [[construction.layer]], or another class");
    }

    void read_class(const schema::Section& section, Zone& zone) const {
        const auto index = static_cast<std::size_t>(section.choice_as<int>("class"));
        zone.capacity_of_layers = index == std::size(physics::capacity_classes);
        if (zone.capacity_of_layers) return check_layers(section, zone);
        const physics::CapacityClass& capacity = physics::capacity_classes[index];
        if (!section.has("heat_capacity")) zone.heat_capacity = capacity.heat_capacity;
        if (!section.has("mass_area_ratio"))
            zone.mass_area_ratio = capacity.mass_area_ratio;
    }

    /// When all zones are known.
    void read_couplings(const schema::Section& section) {
        const int zone = index_of(section, "name", building_.zones, "[[zone]]");
        each_part(section, "coupling", "zone.coupling", [&](const auto& part) {
            physics::ZoneCoupling coupling;
            coupling.zone = index_of(part, "zone", building_.zones, "[[zone]]");
            if (coupling.zone == zone)
                part.fail_value("zone", "a zone cannot be coupled to itself");
            numbers_.read(part, Part::coupling, &coupling);
            building_.zones[static_cast<std::size_t>(zone)].couplings.push_back(coupling);
        });
    }

    void read_air_system(const schema::Section& section) {
        physics::AirSystem system;
        system.name = section.text("name");
        system.variable = section.choice_as<int>("volume") == 1;
        system.limited_by = section.choice_as<physics::EconomiserLimit>("economiser_by");
        numbers_.read(section, Part::air_system, &system);
        check_keys(section, system);
        const int index = static_cast<int>(building_.air_systems.size());
        add_named(section, std::move(system), building_.air_systems);
        bool brings = !section.has("flow");
        for (const std::size_t zone : zones_of(section))
            brings |= serve(section, index, building_.zones[zone]);
        if (!brings && section.is_lost(section.text("flow"))) throw schema::Follows();
        if (!brings)
            section.fail_value("flow",
                               "none of its zones has a [[zone.flow]] of this "
                               "name; expected the name of one");
    }

    static void check_keys(const schema::Section& section,
                           const physics::AirSystem& system) {
        for (const char* key : {"least_flow", "fan_exponent"})
            if (!system.variable && section.has(key))
                section.fail(key,
                             "has no effect with volume = \"constant\"; remove one "
                             "of them");
        if (system.limited_by == physics::EconomiserLimit::differential &&
            section.has("economiser_limit"))
            section.fail("economiser_limit",
                         "has no effect with economiser_by = \"differential\"; expected "
                         "\"dry_bulb\" or \"enthalpy\" there");
    }

    /// Rows of the zones that a system serves.
    std::vector<std::size_t> zones_of(const schema::Section& section) const {
        std::vector<std::size_t> rows;
        const std::vector<std::string> names = names_of(building_.zones);
        rows.reserve(names.size());
        if (!section.has("zones")) {
            for (std::size_t k = 0; k < names.size(); ++k) rows.push_back(k);
            return rows;
        }
        for (const std::string& name : section.texts("zones")) {
            const auto place = std::ranges::find(names, name);
            if (place == names.end() && section.is_lost(name)) throw schema::Follows();
            if (place == names.end())
                section.fail("zones", fmt::format("names \"{}\": there is no [[zone]] of "
                                                  "this name{}",
                                                  name, input::suggestion(name, names)));
            rows.push_back(static_cast<std::size_t>(place - names.begin()));
        }
        if (rows.empty())
            section.fail("zones",
                         "is empty; expected names of zones, or leave it out: "
                         "the system serves all");
        return rows;
    }

    /// The flow is the least supply air: it has what these keys would say.
    static void check_supplied(const schema::Section& section) {
        if (section.choice_as<int>("volume") != 1)
            section.fail_value("volume",
                               "its flow comes from a boundary, as the least supply air "
                               "of terminals; expected \"variable\", or a flow from "
                               "outdoors");
        for (const char* key : {"least_flow", "supply_temperature", "supply_reset"})
            if (section.has(key))
                section.fail(key,
                             "has no effect where the flow comes from a boundary, which "
                             "says it; remove it");
    }

    /// Returns whether the zone has the flow that the system brings.
    bool serve(const schema::Section& section, int index, Zone& zone) const {
        if (zone.air_system >= 0)
            section.fail(
                section.has("zones") ? "zones" : "name",
                fmt::format(
                    "serves zone \"{}\", which air system \"{}\" serves "
                    "already; expected each zone in one system",
                    zone.name,
                    building_.air_systems[static_cast<std::size_t>(zone.air_system)]
                        .name));
        if (zone.thermostat.imposed)
            section.fail("name",
                         fmt::format("serves zone \"{}\", whose imposed_power "
                                     "leaves it nothing to do; remove one of them",
                                     zone.name));
        zone.air_system = index;
        if (!section.has("flow")) return false;
        for (std::size_t k = 0; k < zone.flows.size(); ++k)
            if (zone.flows[k].name == section.text("flow")) {
                if (zone.flows[k].supply != physics::outdoors)
                    check_supplied(section);
                else if (section.has("outdoor_air_change"))
                    section.fail("outdoor_air_change",
                                 "has no effect where the flow comes from outdoors; "
                                 "remove it, or give the flow a supply");
                zone.system_flow = static_cast<int>(k);
                return true;
            }
        return false;
    }

    void read_plant() {
        if (!sources_.has("plant")) return;
        const schema::Section section = sources_.with("plant").table("plant", "plant");
        building_.plant.heating_carrier =
            section.choice_as<physics::Carrier>("heating_carrier");
        building_.plant.cooling_carrier =
            section.choice_as<physics::Carrier>("cooling_carrier");
        numbers_.read(section, Part::plant, &building_.plant);
        check_cycling(section, "heating", building_.plant.heating_least_load);
        check_cycling(section, "cooling", building_.plant.cooling_least_load);
    }

    /// A loss that no load has was meant otherwise.
    static void check_cycling(const schema::Section& plant, const std::string& of,
                              double least_load) {
        const std::string loss = of + "_cycling_loss", least = of + "_least_load";
        if (plant.has(loss) && least_load <= 0)
            plant.fail(loss, fmt::format("is of loads below {0}, which is 0; expected "
                                         "{0}, too, in W/m2, such as {0} = 15",
                                         least));
    }

    const Sources& sources_;
    NumberReader numbers_;
    Building building_;
};

}  // namespace

physics::Building read_building(const Sources& sources,
                                const std::vector<physics::Profile>& profiles) {
    Building building = BuildingReader(sources, profiles).read();
    sources.attempt([&] { read_links(sources, building); }, {"link"});
    return building;
}

}  // namespace bemcal::description
