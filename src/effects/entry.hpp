/// A row of the catalogue: an effect, what it is tried on, and what is said of it.
#pragma once

#include "effects/effect.hpp"

#include <vector>

namespace bemcal::effects {

/// What a row of the catalogue is tried on, beside its shapes.
enum class Each {
    once,
    facade,         ///< all facades with windows together, and each alone
    meter,          ///< every meter of the job that it can enter
    cooling_meter,  ///< that of cooling, where the job has it
    weekday,        ///< Monday to Friday
    summer_time,    ///< gates of summer time by the rules of the EU and the US
    found_days,     ///< days that a caller finds in the data (with_days)
    found_hours,    ///< hours that a caller finds in the data (with_hours)
    data            ///< none: the data are mended or masked, the building is not changed
};

/// One row: an effect with the shapes that its name covers, and what is said of it.
struct Entry {
    Effect effect;                ///< with its first shape
    std::vector<Shape> shapes{};  ///< that are tried; empty = that of the effect
    Each each = Each::once;
    const char* sentence = "";   ///< what it is
    const char* signature = "";  ///< what it leaves in the residual
    const char* like = "";       ///< what it can be mistaken for
    const char* same_as = "";    ///< what it is in all readings; "" = nothing
    const char* separates = "";  ///< the measurement that would tell them apart
};

}  // namespace bemcal::effects
