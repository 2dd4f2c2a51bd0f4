/// Reads lists of quantities: "heating", "electricity", ...
/// Follows from their rows in physics/quantities.
/// A single quantity is a choice, which the schema reads.
#include "description/read_quantities.hpp"

#include "description/words.hpp"

#include <algorithm>

namespace bemcal::description {

using physics::Quantity;

std::vector<Quantity> read_quantities(const schema::Section& section,
                                      std::string_view key) {
    const std::vector<std::string> names(physics::quantity_names.begin(),
                                         physics::quantity_names.end());
    std::vector<Quantity> chosen;
    section.attempt_each(section.texts(key), [&](const std::string& word) {
        check_word(section, key, word, names, "quantity");
        chosen.push_back(
            static_cast<Quantity>(std::ranges::find(names, word) - names.begin()));
    });
    return chosen;
}

}  // namespace bemcal::description
