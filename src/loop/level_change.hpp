/// How far the level of an energy meter wanders from year to year.
#pragma once

#include "physics/quantities.hpp"

namespace bemcal::loop {

/// What its logarithm does from one year to the next, beyond the weather, as a standard
/// deviation: use and operation change. Source: 232 buildings with two years of bills
/// (bench/bench_level_change.py). 0 of a temperature.
inline double usual_level_change(physics::Quantity quantity) {
    constexpr double of_electricity = 0.06, of_fuel = 0.18;
    using physics::Measured;
    const Measured measured = physics::row_of(quantity).measured;
    if (measured == Measured::temperature) return 0;
    return measured == Measured::electricity ? of_electricity : of_fuel;
}

}  // namespace bemcal::loop
