/// Reads [[parameter]]: uncertain numbers of the building, their ranges, and the numbers
/// that they replace, multiply or shift.
/// Follows from `fields()`: both ends of a range must keep every number within its
/// limits, linked ones too.
/// What links do between the two ends is not looked at. Priors are in `read_prior`.
#include "description/building_readers.hpp"
#include "description/read_prior.hpp"
#include "physics/derived.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using physics::Building;
using physics::Effect;
using physics::Parameter;
using physics::Target;

void read_targets(const schema::Section& section, const Building& building,
                  Parameter& parameter) {
    const std::vector<std::string> paths = section.texts("target");
    if (paths.empty()) section.fail("target", "is empty; expected the path of a number");
    section.attempt_each(paths, [&](const std::string& path) {
        const std::vector<Target> found = resolved_at(section, "target", building, path);
        parameter.targets.insert(parameter.targets.end(), found.begin(), found.end());
    });
    for (const Target& target : parameter.targets)
        if (physics::is_derived(building, target))
            section.fail("target",
                         fmt::format("{} follows from others, by a [[link]] or from "
                                     "layers; expected one of those in its place",
                                     field_of(target).key));
    const auto unit_at = [&](const Target& target) {
        return std::string(physics::info_of(building, target).unit);
    };
    for (const Target& target : parameter.targets)
        if (unit_at(target) != unit_at(parameter.targets[0]))
            section.fail("target",
                         fmt::format("links numbers in {} and in {}; expected one unit",
                                     unit_at(parameter.targets[0]), unit_at(target)));
}

/// What a number of the building becomes at `value`.
double effect_of(const Parameter& parameter, double nominal, double value) {
    if (parameter.effect == Effect::factor) return nominal * value;
    return parameter.effect == Effect::offset ? nominal + value : value;
}

/// Min and max, or the first and last of its values.
void read_range(const schema::Section& section, Parameter& parameter) {
    if (section.has("values")) {
        const std::vector<double> values = read_values(section);
        parameter.least = values.front();
        parameter.most = values.back();
        return;
    }
    const auto needed = [&](const char* key) {
        section.node(key);
        return section.number(key);
    };
    section.attempt_all([&] { parameter.least = needed("min"); },
                        [&] { parameter.most = needed("max"); });
    if (parameter.least >= parameter.most)
        section.fail("min", fmt::format("is {:g}, but max = {:g}; expected min < max",
                                        parameter.least, parameter.most));
}

/// One end of the range, which a key says.
void check_end(const schema::Section& section, const char* key, const Building& building,
               const Parameter& parameter, double end) {
    for (const Target& target : parameter.targets) {
        const physics::NumberInfo info = physics::info_of(building, target);
        const double value =
            effect_of(parameter, physics::number_at(building, target), end);
        if (value >= info.least && value <= info.most) continue;
        section.fail_value(
            key, fmt::format("makes {} = {:g}: expected {:g} to {:g} {} ({})", info.name,
                             value, info.least, info.most, info.unit, info.sentence));
    }
}

void check_range(const schema::Section& section, const Building& building,
                 const Parameter& parameter) {
    const bool has_values = section.has("values");
    check_end(section, has_values ? "values" : "min", building, parameter,
              parameter.least);
    check_end(section, has_values ? "values" : "max", building, parameter,
              parameter.most);
}

/// What follows from the parameter stays within its ranges, too.
void check_links(const schema::Section& section, const Building& building,
                 const Parameter& parameter) {
    Building changed = building;
    const bool has_values = section.has("values");
    for (const double end : {parameter.least, parameter.most}) {
        physics::apply(building, {&parameter, 1}, {&end, 1}, changed);
        const char* key = has_values ? "values" : end == parameter.least ? "min" : "max";
        check_linked(section, key, changed);
    }
}

/// A factor has none, and a shift of a temperature is a difference.
std::string unit_of(const Building& building, const Parameter& parameter) {
    if (parameter.effect == Effect::factor) return "-";
    const std::string unit = physics::info_of(building, parameter.targets[0]).unit;
    return parameter.effect == Effect::offset && unit == "degC" ? "K" : unit;
}

double nominal_of(const Building& building, const Parameter& parameter) {
    if (parameter.effect == Effect::factor) return 1;
    if (parameter.effect == Effect::offset) return 0;
    return physics::number_at(building, parameter.targets[0]);
}

std::string read_name(const schema::Section& section,
                      const std::vector<Parameter>& before) {
    std::string name = section.text("name");
    if (std::ranges::find(before, name, &Parameter::name) != before.end())
        section.fail_value("name", "another parameter has this name");
    return name;
}

/// Two parameters that write to the same place: the later one would undo the earlier.
void check_overlap(const schema::Section& section, const Building& building,
                   const std::vector<Parameter>& before, const Parameter& parameter) {
    for (const Parameter& other : before)
        for (const Target& a : other.targets)
            for (const Target& b : parameter.targets)
                if (physics::is_same_number(a, b))
                    section.fail(
                        "target",
                        fmt::format("sets the same {} as the parameter {}",
                                    physics::info_of(building, b).name, other.name));
}

Parameter read_parameter(const schema::Section& section, const Building& building,
                         const std::vector<Parameter>& before) {
    Parameter parameter;
    section.attempt_all([&] { parameter.name = read_name(section, before); },
                        [&] { parameter.effect = section.choice_as<Effect>("mode"); },
                        [&] { read_range(section, parameter); },
                        [&] {
                            read_targets(section, building, parameter);
                            check_overlap(section, building, before, parameter);
                        });
    check_range(section, building, parameter);
    check_links(section, building, parameter);
    parameter.unit = unit_of(building, parameter);
    parameter.nominal = nominal_of(building, parameter);
    return parameter;
}

/// The building has it from here on, where a study does not vary it.
void read_value(const schema::Section& section, Parameter& parameter,
                Building& building) {
    if (!section.has("value")) return;
    const double value = section.number("value");
    if (value < parameter.least || value > parameter.most)
        section.fail_value("value",
                           fmt::format("expected {:g} to {:g}, the range of {}",
                                       parameter.least, parameter.most, parameter.name));
    physics::set_nominal(value, parameter, building);
}

}  // namespace

void read_parameters(const Sources& sources, study::Case& building) {
    sources.each("parameter", [&](const schema::Section& section) {
        Parameter parameter;
        study::ParameterPrior prior;
        section.attempt_all(
            [&] {
                parameter =
                    read_parameter(section, building.building, building.parameters);
                read_value(section, parameter, building.building);
            },
            [&] { prior = read_prior(section); });
        place_prior(section, parameter, prior);
        building.priors.push_back(std::move(prior));
        building.parameters.push_back(std::move(parameter));
    });
}

}  // namespace bemcal::description
