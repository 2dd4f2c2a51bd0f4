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

/// Index of the one of a kind that the key names; the error lists what there is.
template <class Named>
int index_of(const schema::Section& section, const char* key,
             const std::vector<Named>& list, const char* kind) {
    const std::string name = section.text(key);
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].name == name) return static_cast<int>(i);
    if (section.is_lost(fmt::format("{}.{}", kind, name))) throw schema::Follows();
    if (list.empty() && section.n_failures() == 0)
        section.fail_value(
            key, fmt::format("there is no [[{}]] of this name, nor any other", kind));
    section.fail_value(key, fmt::format("there is no [[{}]] of this name{}", kind,
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
        section.attempt_each(physics::fields(), [&](const Field& field) {
            if (field.part != part || field.key == left_out) return;
            read_field(section, field, object);
        });
    }

  private:
    void read_field(const schema::Section& section, const Field& field,
                    void* object) const {
        if (field.constant != nullptr)
            *field.constant(object) = section.number(field.key);
        else
            *field.input(object) = read_input(section, field);
    }

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
        Input input{1, 0, -1};
        parts.attempt_all(
            [&] {
                parts.refuse({"schedule", "low"},
                             "has no place beside series; remove one of them");
            },
            [&] { parts.number_if("value", input.value); },
            [&] { input.profile = profile_of(parts, "series", true); });
        return input;
    }

    Input read_scheduled(const schema::Section& parts, const schema::Key& row) const {
        Input input;
        const auto checked = [&](const char* key) {
            return schema::checked_number(parts.node(key), row, parts.where(key));
        };
        parts.attempt_all([&] { input.value = checked("value"); },
                          [&] {
                              if (parts.has("low")) input.low = checked("low");
                          },
                          [&] {
                              if (parts.has("schedule"))
                                  input.profile = profile_of(parts, "schedule", false);
                              else if (parts.has("low"))
                                  parts.fail(
                                      "low",
                                      "has no effect without schedule; add schedule = "
                                      "\"name\"");
                          });
        return input;
    }

    /// -1 of one that could not be read, a schedule or a series: nobody asks for its
    /// hours then, and the section has what others refer to.
    int profile_of(const schema::Section& parts, const char* key, bool is_series) const {
        const std::string name = parts.text(key);
        const bool is_there =
            std::ranges::find(profiles_, name, &Profile::name) != profiles_.end();
        if (!is_there && parts.is_lost("schedule.series." + name)) return -1;
        const int profile = index_of(parts, key, profiles_, key);
        if (profiles_[static_cast<std::size_t>(profile)].is_series != is_series)
            parts.fail_value(key, is_series
                                      ? "is a schedule; write schedule in place of series"
                                      : "is a series; write series in place of schedule");
        return profile;
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
    /// A name that none of the list has.
    template <class Item>
    static std::string new_name(const schema::Section& section, std::string name,
                                const std::vector<Item>& list) {
        for (const Item& other : list)
            if (other.name == name)
                section.fail_value(
                    "name", fmt::format("another {} has this name", section.schema()));
        if (name.find_first_of(".*") != std::string::npos)
            section.fail_value("name",
                               "has a dot or a star, which mean something in a "
                               "parameter's target; expected another name");
        return name;
    }

    template <class Item>
    static std::string new_name(const schema::Section& section,
                                const std::vector<Item>& list) {
        return new_name(section, section.text("name"), list);
    }

    /// The name as written, or "surface_3".
    template <class Item>
    static std::string name_or_number(const schema::Section& section,
                                      const std::vector<Item>& list, const char* kind) {
        return section.has("name")
                   ? new_name(section, list)
                   : new_name(section, fmt::format("{}_{}", kind, list.size() + 1), list);
    }

    void read_construction(const schema::Section& section) {
        physics::Construction construction;
        section.attempt_all(
            [&] { construction.name = new_name(section, building_.constructions); },
            [&] { read_layers(section, construction); },
            [&] {
                const bool has_layers = !section.list_of_tables("layer").empty();
                numbers_.read(section, Part::construction, &construction,
                              has_layers ? "u_value" : "");
            });
        building_.constructions.push_back(std::move(construction));
    }

    void read_glazing(const schema::Section& section) {
        physics::Glazing glazing;
        section.attempt_all(
            [&] { glazing.name = new_name(section, building_.glazings); },
            [&] { numbers_.read(section, Part::glazing, &glazing); },
            [&] { glazing.angle_modifier = section.numbers("angle_modifier"); });
        if (!glazing.angle_modifier.empty() && !section.has("incidence_factor"))
            glazing.incidence_factor = 1;
        building_.glazings.push_back(std::move(glazing));
    }

    void read_boundary(const schema::Section& section) {
        physics::Boundary boundary;
        section.attempt_all(
            [&] { boundary.name = new_name(section, building_.boundaries); },
            [&] { numbers_.read(section, Part::boundary, &boundary); });
        building_.boundaries.push_back(std::move(boundary));
    }

    void read_envelope() {
        sources_.each("construction",
                      [&](const auto& section) { read_construction(section); });
        sources_.each("glazing", [&](const auto& section) { read_glazing(section); });
        sources_.each("boundary", [&](const auto& section) { read_boundary(section); });
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
            part.attempt_all(
                [&] { layer.name = name_or_number(part, construction.layers, "layer"); },
                [&] { numbers_.read(part, Part::layer, &layer); });
            construction.layers.push_back(std::move(layer));
        });
        if (!construction.layers.empty())
            section.refuse({"u_value"}, "follows from the layers; remove it, or them");
    }

    int boundary_of(const schema::Section& section, const char* key) {
        if (section.text(key) == "outdoors") return physics::outdoors;
        return index_of(section, key, building_.boundaries, "boundary");
    }

    static physics::Plane plane_of(const schema::Section& section) {
        const double tilt = section.number("tilt");
        if (!section.has("azimuth") && tilt > 0 && tilt < 180)
            section.fail("azimuth",
                         "is missing; expected degrees clockwise from north (0 = "
                         "north, 90 = east, 180 = south)");
        double azimuth = section.has("azimuth") ? section.number("azimuth") : 0;
        azimuth = std::fmod(azimuth + 360, 360);
        return {radians(tilt), radians(azimuth), {}};
    }

    /// What is behind it, and how it lies in the sun.
    void read_place(const schema::Section& section, physics::Surface& surface) {
        surface.boundary = boundary_of(section, "boundary");
        surface.in_sun = section.has("in_sun") ? section.flag("in_sun")
                                               : surface.boundary == physics::outdoors;
        if (surface.in_sun)
            surface.plane = building_.plane_index(plane_of(section));
        else  // it may say how it lies, but nothing follows
            for (const char* key : {"azimuth", "tilt"})
                if (section.has(key)) section.number(key);
    }

    void read_surface(const schema::Section& section, Zone& zone) {
        physics::Surface surface;
        section.attempt_all(
            [&] { surface.name = name_or_number(section, zone.surfaces, "surface"); },
            [&] {
                surface.construction = index_of(section, "construction",
                                                building_.constructions, "construction");
            },
            [&] { read_place(section, surface); },
            [&] {
                numbers_.read(section, Part::surface, &surface);
                check_area(section, surface.area);
            });
        zone.surfaces.push_back(std::move(surface));
    }

    void read_window(const schema::Section& section, Zone& zone) {
        physics::Window window;
        physics::Plane plane;
        section.attempt_all(
            [&] { window.name = name_or_number(section, zone.windows, "window"); },
            [&] {
                window.glazing =
                    index_of(section, "glazing", building_.glazings, "glazing");
            },
            [&] { plane = plane_of(section); },
            [&] {
                numbers_.read(section, Part::window, &window);
                check_area(section, window.area);
            });
        plane.modifier =
            building_.glazings[static_cast<std::size_t>(window.glazing)].angle_modifier;
        window.plane = building_.plane_index(plane);
        zone.windows.push_back(std::move(window));
    }

    static void check_area(const schema::Section& section, double area) {
        if (area <= 0)
            section.fail_value("area",
                               "expected more than 0 m2; leave the element out if it "
                               "is not there");
    }

    void read_flow(const schema::Section& section, Zone& zone) {
        physics::AirFlow flow;
        section.attempt_all(
            [&] { flow.name = new_name(section, zone.flows); },
            [&] { numbers_.read(section, Part::flow, &flow); },
            [&] {
                flow.supply = boundary_of(section, "supply");
                if (flow.supply != physics::outdoors)
                    section.refuse({"heat_recovery"},
                                   "works on outdoor air only; remove it, or supply");
            });
        zone.flows.push_back(std::move(flow));
    }

    void read_load(const schema::Section& section, Zone& zone) {
        physics::Load load;
        section.attempt_all(
            [&] { load.name = new_name(section, zone.loads); },
            [&] { load.carrier = section.choice_as<physics::Carrier>("carrier"); },
            [&] { numbers_.read(section, Part::load, &load); });
        zone.loads.push_back(std::move(load));
    }

    void read_zone(const schema::Section& section) {
        Zone zone;
        section.attempt_all([&] { zone.name = new_name(section, building_.zones); },
                            [&] { numbers_.read(section, Part::zone, &zone); },
                            [&] { read_heating(section, zone); },
                            [&] { read_parts(section, zone); });
        if (section.has("class")) read_class(section, zone);
        building_.zones.push_back(std::move(zone));
    }

    /// By a radiator, by imposed power, or else by set-points.
    void read_heating(const schema::Section& section, Zone& zone) const {
        if (section.has("radiator")) read_radiator(section, zone);
        zone.thermostat.imposed = section.has("imposed_power");
        if (zone.thermostat.imposed)
            section.refuse({"heating_set_point", "cooling_set_point", "heating_limit",
                            "cooling_limit"},
                           "has no effect beside imposed_power; remove one of them");
    }

    /// All of them, whatever is wrong with one.
    void read_parts(const schema::Section& section, Zone& zone) {
        section.attempt_all(
            [&] {
                each_part(section, "surface", "zone.surface",
                          [&](const auto& part) { read_surface(part, zone); });
            },
            [&] {
                each_part(section, "window", "zone.window",
                          [&](const auto& part) { read_window(part, zone); });
            },
            [&] {
                each_part(section, "flow", "zone.flow",
                          [&](const auto& part) { read_flow(part, zone); });
            },
            [&] {
                each_part(section, "load", "zone.load",
                          [&](const auto& part) { read_load(part, zone); });
            });
    }

    void read_radiator(const schema::Section& section, Zone& zone) const {
        section.attempt_all(
            [&] {
                section.refuse(
                    {"heating_set_point", "heating_capacity", "heating_available",
                     "heating_limit", "imposed_power", "emitter_time_constant",
                     "emitter_radiant_share"},
                    "has no effect beside [zone.radiator]; remove one of them");
            },
            [&] {
                read_radiator_itself(section.table("radiator", "zone.radiator"),
                                     zone.radiator.emplace());
            });
    }

    void read_radiator_itself(const schema::Section& section,
                              physics::ZoneRadiator& radiator) const {
        section.attempt_all([&] { numbers_.read(section, Part::radiator, &radiator); },
                            [&] {
                                radiator.radiator.n_elements =
                                    static_cast<int>(section.integer("elements"));
                            },
                            [&] { check_supply(section); });
        if (section.has("supply_temperature") && !section.has("supply_measured"))
            radiator.measured.value = 1;
    }

    static void check_supply(const schema::Section& radiator) {
        if (!radiator.has("supply_temperature"))
            radiator.refuse({"supply_measured", "flow"},
                            "has no effect without supply_temperature; add that, or "
                            "remove this");
    }

    void check_layers(const schema::Section& section, const Zone& zone) const {
        section.refuse({"heat_capacity", "mass_area_ratio"},
                       "follows from the layers; remove it, or class");
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
        each_part(section, "coupling", "zone.coupling", [&](const auto& part) {
            physics::ZoneCoupling coupling;
            part.attempt_all([&] { coupling.zone = coupled_zone(section, part); },
                             [&] { numbers_.read(part, Part::coupling, &coupling); });
            const int zone = index_of(section, "name", building_.zones, "zone");
            building_.zones[static_cast<std::size_t>(zone)].couplings.push_back(coupling);
        });
    }

    int coupled_zone(const schema::Section& zone, const schema::Section& part) const {
        if (part.text("zone") == zone.text("name"))
            part.fail_value("zone", "a zone cannot be coupled to itself");
        return index_of(part, "zone", building_.zones, "zone");
    }

    void read_air_system(const schema::Section& section) {
        physics::AirSystem system;
        std::vector<std::size_t> zones;
        section.attempt_all(
            [&] { system.name = new_name(section, building_.air_systems); },
            [&] { numbers_.read(section, Part::air_system, &system); },
            [&] { read_ways(section, system); }, [&] { zones = zones_of(section); });
        const int index = static_cast<int>(building_.air_systems.size());
        building_.air_systems.push_back(std::move(system));
        bool brings = !section.has("flow");
        for (const std::size_t zone : zones)
            brings |= serve(section, index, building_.zones[zone]);
        if (!brings && section.is_lost("flow." + section.text("flow")))
            throw schema::Follows();
        if (!brings)
            section.fail_value("flow",
                               "none of its zones has a [[zone.flow]] of this "
                               "name; expected the name of one");
    }

    /// How its fan and its economiser work.
    static void read_ways(const schema::Section& section, physics::AirSystem& system) {
        section.attempt_all(
            [&] {
                system.variable = section.choice_as<int>("volume") == 1;
                if (!system.variable)
                    section.refuse({"least_flow", "fan_exponent"},
                                   "has no effect with volume = \"constant\"; remove one "
                                   "of them");
            },
            [&] {
                system.limited_by =
                    section.choice_as<physics::EconomiserLimit>("economiser_by");
                if (system.limited_by == physics::EconomiserLimit::differential)
                    section.refuse({"economiser_limit"},
                                   "has no effect with economiser_by = "
                                   "\"differential\"; expected \"dry_bulb\" or "
                                   "\"enthalpy\" there");
            });
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
            if (place == names.end() && section.is_lost("zone." + name))
                throw schema::Follows();
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
        section.refuse({"least_flow", "supply_temperature", "supply_reset"},
                       "has no effect where the flow comes from a boundary, which says "
                       "it; remove it");
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
        physics::Plant& plant = building_.plant;
        section.attempt_all(
            [&] {
                plant.heating_carrier =
                    section.choice_as<physics::Carrier>("heating_carrier");
            },
            [&] {
                plant.cooling_carrier =
                    section.choice_as<physics::Carrier>("cooling_carrier");
            },
            [&] { numbers_.read(section, Part::plant, &plant); });
        section.attempt_all(
            [&] { check_cycling(section, "heating", plant.heating_least_load); },
            [&] { check_cycling(section, "cooling", plant.cooling_least_load); });
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
