/// Refuses a word that is none of some names, with the nearest of them, and a path to
/// numbers that are not there. Neither is refused where it may mean what could not be
/// read; of a path, kinds and numbers are looked at even then. Follows from `suggestion`
/// and `resolve`.
/// What the names are of is said by the caller.
#include "description/words.hpp"

#include "input/suggest.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

namespace bemcal::description {

void check_word(const schema::Section& section, std::string_view key,
                const std::string& word, const std::vector<std::string>& names,
                const std::string& what) {
    if (std::ranges::find(names, word) != names.end()) return;
    if (section.is_lost(word)) throw schema::Follows();
    section.fail(key, fmt::format("\"{}\" is no {}{}", word, what,
                                  input::suggestion(word, names)));
}

namespace {

/// Whether there is any of the kind that the path begins with: without, the paths of that
/// kind are not known.
bool has_kind_of(const physics::Building& building, const std::string& path) {
    const std::string kind = path.substr(0, path.find('.'));
    if (kind == "construction") return !building.constructions.empty();
    if (kind == "glazing") return !building.glazings.empty();
    if (kind == "boundary") return !building.boundaries.empty();
    if (kind == "air_system") return !building.air_systems.empty();
    return kind != "zone" || !building.zones.empty();
}

/// A building with all the names of the path, "zone.NAME.flow.NAME.air_change": whether
/// its kinds and its number are right, it tells whatever the names are of.
physics::Building with_names_of(const std::string& path) {
    std::vector<std::string> words;
    std::istringstream parts(path);
    for (std::string word; std::getline(parts, word, '.');) words.push_back(word);
    words.resize(std::max<std::size_t>(words.size(), 4));
    const std::string &outer = words[1], &inner = words[3];
    physics::Building building;
    building.constructions.emplace_back().name = outer;
    building.constructions[0].layers.emplace_back().name = inner;
    building.glazings.emplace_back().name = outer;
    building.boundaries.emplace_back().name = outer;
    building.air_systems.emplace_back().name = outer;
    building.zones.resize(2);
    building.zones[1].name = inner;
    physics::Zone& zone = building.zones[0];
    zone.name = outer;
    zone.surfaces.emplace_back().name = inner;
    zone.windows.emplace_back().name = inner;
    zone.flows.emplace_back().name = inner;
    zone.loads.emplace_back().name = inner;
    zone.couplings.emplace_back().zone = 1;
    zone.radiator.emplace();
    return building;
}

}  // namespace

std::vector<physics::Target> resolved_at(const schema::Section& section,
                                         std::string_view key,
                                         const physics::Building& building,
                                         const std::string& path) {
    const bool is_known = section.n_failures() == 0 || has_kind_of(building, path);
    if (section.is_lost(path) || !is_known) {
        if (!path.starts_with("effect."))
            at_key(section, key, [&] { physics::resolve(with_names_of(path), path); });
        throw schema::Follows();
    }
    return at_key(section, key, [&] { return physics::resolve(building, path); });
}

}  // namespace bemcal::description
