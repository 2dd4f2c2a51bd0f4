/// Refuses a word that is none of some names, with the nearest of them.
/// Follows from `suggestion`.
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
    section.fail(key, fmt::format("\"{}\" is no {}{}", word, what,
                                  input::suggestion(word, names)));
}

}  // namespace bemcal::description
