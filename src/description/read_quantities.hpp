/// Quantities of a building that words of a job name.
#pragma once

#include "physics/quantities.hpp"
#include "schema/section.hpp"

#include <string_view>
#include <vector>

namespace bemcal::description {

/// Throws UserError at `key` for a word that names none.
std::vector<physics::Quantity> read_quantities(const schema::Section& section,
                                               std::string_view key);

}  // namespace bemcal::description
