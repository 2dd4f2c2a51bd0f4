/// An effect that was found, with what is said of it.
#pragma once

#include "effects/effect.hpp"
#include "study/summary.hpp"

#include <string>
#include <vector>

namespace bemcal::loop {

/// NaN where nobody asked.
using Named = study::PossibleName;

/// An effect that was accepted, with what cannot be told apart from it.
struct Found {
    std::vector<Named> names;  ///< of its class, its own first
    std::string doubt;  ///< why its name may be the nearest one only; "" = adequate
    double gain = 0;
    double needed = 0;                      ///< what noise would have shown in its round
    std::vector<effects::Effect> rivals{};  ///< what may stand in its place
    // What its coefficient owes, as root mean squares in its unit:
    double of_shape = 0;    ///< to the shape that it has (deviation_over_shapes)
    double of_missing = 0;  ///< to what may still be missing; 0 after `most_effects`
};

}  // namespace bemcal::loop
