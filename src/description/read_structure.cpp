/// Reads `structure`: refinements of the standard's zone that a building has in every
/// study. Their numbers are parameters with the priors of the table, unless a
/// [[parameter]] leads to them; so are the coefficients of what they bring as effects.
/// Follows from `effects::refinements`, where each says what it changes.
#include "description/building_readers.hpp"
#include "effects/refinements.hpp"
#include "physics/derived.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using effects::Refinement;
using effects::refinements;

std::size_t refinement_named(const schema::Section& section, const std::string& name) {
    check_word(section, "structure", name, names_of(refinements()), "refinement");
    const auto row = std::ranges::find(refinements(), name, &Refinement::name);
    return static_cast<std::size_t>(row - refinements().begin());
}

void add(const schema::Section& section, std::size_t refinement, study::Case& building) {
    const char* name = refinements()[refinement].name;
    for (const std::size_t there : building.structure)
        if (effects::are_of_one_kind(there, refinement))
            section.fail("structure",
                         fmt::format("\"{}\" has no place beside \"{}\"; expected one of "
                                     "them, once",
                                     name, refinements()[there].name));
    building.structure.push_back(refinement);
    const auto change = refinements()[refinement].change;
    if (change != nullptr && !change(building.building))
        section.fail("structure",
                     fmt::format("\"{}\" finds nothing to change in this building; leave "
                                 "it out",
                                 name));
}

void add_parameter(physics::Parameter parameter, double mean, double sd,
                   study::Case& building) {
    building.priors.push_back(
        {{stats::PriorKind::normal, mean, sd, parameter.least, parameter.most}, {}});
    building.parameters.push_back(std::move(parameter));
}

/// Whether a section has the number at such a path: "zone.*.room_spread.low",
/// "plant.heating_auxiliary".
bool is_written(const Sources& sources, std::string_view path) {
    const auto dot = path.find('.');
    const std::string part(path.substr(0, dot));
    std::string_view key = path.substr(dot + 1);
    const bool is_list = key.starts_with("*.");
    if (is_list) key.remove_prefix(2);
    key = key.substr(0, key.find('.'));
    const auto has_it = [&](const schema::Section& section) { return section.has(key); };
    const schema::Section& from = sources.with(part);
    if (is_list) return std::ranges::any_of(from.tables(part, part.c_str()), has_it);
    return part == "plant" && from.has(part) && has_it(from.table(part, "plant"));
}

bool has_section(const Sources& sources, const std::string& effect) {
    return std::ranges::any_of(
        sources.with("effect").tables("effect", "effect"),
        [&](const schema::Section& each) { return each.text("name") == effect; });
}

/// Unless a parameter of the job leads to its coefficient.
void add_coefficient(const Refinement::Always& always, study::Case& building) {
    const auto& all = building.building.effects;
    const auto effect =
        std::ranges::find(all, always.effect.name, &physics::Coefficient::name);
    const auto writes_to_it = [&](const physics::Parameter& parameter) {
        return physics::is_same_number(parameter.targets[0], effect->targets[0]);
    };
    if (std::ranges::any_of(building.parameters, writes_to_it)) return;
    auto [least, most] =
        effects::limits_of(always.mean, always.sd, always.least, always.most);
    least = std::max(least, effect->least);
    most = std::min(most, effect->most);
    add_parameter({effect->name, effect->unit, least, most, physics::Effect::replace,
                   effect->targets, always.mean},
                  always.mean, always.sd, building);
}

}  // namespace

void read_structure(const Sources& sources, study::Case& building) {
    if (!sources.has("structure")) return;
    const schema::Section& section = sources.with("structure");
    for (const std::string& name : section.texts("structure"))
        add(section, refinement_named(section, name), building);
}

void add_parameters_of_structure(const Sources& sources, study::Case& building) {
    for (const std::size_t index : building.structure) {
        for (const Refinement::Number& number : refinements()[index].numbers) {
            if (is_written(sources, number.path)) continue;
            if (auto parameter =
                    effects::add_number(number, building.parameters, building.building))
                add_parameter(std::move(*parameter), number.mean, number.sd, building);
        }
        for (const Refinement::Always& always : refinements()[index].effects)
            if (!has_section(sources, always.effect.name))
                add_coefficient(always, building);
    }
    physics::derive(building.building);
}

}  // namespace bemcal::description
