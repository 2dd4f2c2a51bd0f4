/// Every numeric input of a building: ONE table gives it its name, unit, default, range
/// and a sentence. The job's reader, `describe parameters` and paths to parameters all
/// use it.
#pragma once

#include "physics/building.hpp"

#include <span>

namespace bemcal::physics {

/// Where a number lives in a part: exactly one of the two accessors is set.
struct Field {
    Part part;
    const char* key;  ///< as in the job file, e.g. "u_value"
    const char* unit;
    double fallback;     ///< default; NaN = required
    double least, most;  ///< accepted range, for messages
    const char* sentence;
    Input* (*input)(void* part);      ///< an Input, else nullptr
    double* (*constant)(void* part);  ///< a constant, else nullptr
};
std::span<const Field> fields();

}  // namespace bemcal::physics
