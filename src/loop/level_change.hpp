/// How far the level of an energy meter wanders from year to year.
#pragma once

#include "loop/decisions.hpp"
#include "physics/quantities.hpp"

namespace bemcal::loop {

/// What its logarithm does from one year to the next, beyond the weather, as a standard
/// deviation: use and operation change. 0 of a temperature.
inline double usual_level_change(physics::Quantity quantity) {
    using physics::Measured;
    const Measured measured = physics::row_of(quantity).measured;
    if (measured == Measured::temperature) return 0;
    return measured == Measured::electricity ? decisions::change_of_electricity
                                             : decisions::change_of_fuel;
}

}  // namespace bemcal::loop
