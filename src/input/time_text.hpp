/// The time of a cell, with or without a form of strptime.
#pragma once

#include "input/time_format.hpp"

namespace bemcal::input {

/// Throws std::invalid_argument with a sentence that says what was expected.
Stamp parse_stamp(std::string_view text, const std::string& format = "");

}  // namespace bemcal::input
