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

std::vector<physics::Target> resolved_at(const schema::Section& section,
                                         std::string_view key,
                                         const physics::Building& building,
                                         const std::string& path) {
    if (section.is_lost(path)) throw schema::Follows();
    return at_key(section, key, [&] { return physics::resolve(building, path); });
}

}  // namespace bemcal::description
