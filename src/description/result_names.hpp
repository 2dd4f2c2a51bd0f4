/// Names of a job that become groups of its result, and what they may not be: a slash
/// parts the names of a result, and some names stand there already.
#pragma once

#include "schema/section.hpp"

#include <string>

namespace bemcal::description {

enum class Named { building, study, period, meter };

/// Why nothing of this kind may have the name; "" where it may.
std::string refusal_of_name(Named kind, const std::string& name);

/// Throws UserError at the key where the name is refused.
void check_name(const schema::Section& section, std::string_view key, Named kind,
                const std::string& name);

}  // namespace bemcal::description
