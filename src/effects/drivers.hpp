/// What an effect may follow: ONE row for each driver. Names, series, moves of thresholds
/// and the grammar's candidates all come from it.
///
/// A new driver is an enumerator (effect.hpp) and a row in drivers.cpp, at the same
/// place.
#pragma once

#include "effects/grammar.hpp"
#include "effects/surroundings.hpp"
#include "physics/weather.hpp"

#include <array>
#include <span>
#include <vector>

namespace bemcal::effects {

/// What a driver brings to a group of the grammar.
struct Cells {
    unsigned group = 0;                        ///< of Follows; 0 = nothing
    std::vector<Shape> (*shapes)() = nullptr;  ///< each is a candidate
    Gate gate = Gate::always;
};

struct DriverRow {
    Driver driver;
    const char* name;
    const char* unit;  ///< of its differences; "" = none
    /// How far a search moves a threshold first [unit]; 0 = it stays where it is.
    double first_move;
    /// Its series by the weather alone, hour by hour, or by all that surrounds the effect
    /// [n_steps]: exactly one of the two. Empty where they lack what it takes.
    std::vector<double> (*of_weather)(const physics::Weather&) = nullptr;
    std::vector<double> (*of_steps)(const Effect&, const Surroundings&) = nullptr;
    const char* unit_of_threshold = nullptr;  ///< where it is another than `unit`
    std::array<Cells, 2> grammar{};
    bool has_number = false;  ///< Shape::at is a number of its own, and no threshold
};

/// In the order of Driver.
std::span<const DriverRow> driver_rows();
const DriverRow& row_of(Driver driver);
/// Whether it is the sun on a facade's windows.
bool follows_sun_on_facade(Driver driver);
/// The unit of a driver's values: of a temperature not that of its differences.
const char* unit_of_values(Driver driver);

/// The driver [n_steps]; empty where the surroundings lack it. Of another_day and
/// shifted_hours: 1, since their profiles are those of each input (schedules.hpp).
std::vector<double> driver_of(const Effect& effect, const Surroundings& surroundings);

}  // namespace bemcal::effects
