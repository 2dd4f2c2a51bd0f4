/// Refuses a word that is none of some names, with the nearest of them, and a path to
/// numbers that are not there. Neither is refused where it may mean what could not be
/// read. Follows from `suggestion` and `resolve`.
/// What the names are of is said by the caller.
#include "description/words.hpp"

#include "input/suggest.hpp"

#include <algorithm>

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

}  // namespace

std::vector<physics::Target> resolved_at(const schema::Section& section,
                                         std::string_view key,
                                         const physics::Building& building,
                                         const std::string& path) {
    const bool is_known = section.n_failures() == 0 || has_kind_of(building, path);
    if (section.is_lost(path) || !is_known) throw schema::Follows();
    return at_key(section, key, [&] { return physics::resolve(building, path); });
}

}  // namespace bemcal::description
