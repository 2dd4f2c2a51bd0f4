/// What a job says, as a hash: the same whatever its comments, its layout and the order
/// of its keys are.
#pragma once

#include <string>
#include <string_view>

namespace bemcal::job {

/// Without the keys that only say how a night is run: its budget, its hours, when drift
/// is told, what is kept, where the table lies; what its lines say has a hash of its own.
/// \param file  named where the text is not TOML: throws UserError
std::string content_hash(std::string_view text, const std::string& file);

}  // namespace bemcal::job
