/// A building's readings and what its model foretells, by quarters of a day.
#pragma once

#include "base/matrix.hpp"
#include "study/case.hpp"

#include <cstddef>
#include <vector>

namespace bemcal::stock {

/// A column: a quarter of the days of a meter, or whole days where it is read by the day.
struct DayFeature {
    std::size_t meter = 0;    ///< of the case
    std::size_t quarter = 0;  ///< from midnight on
    bool is_whole_day = false;
};

/// All whole days of the periods, which follow each other.
struct DaySums {
    physics::Seconds first{};  ///< begin of the first day
    std::vector<DayFeature> features;
    Matrix measured, predicted;  ///< [days x features] kWh, or mean degC; NaN = missing
    /// Of each meter its readings, one after the other.
    struct Series {
        std::vector<physics::Seconds> begins;
        std::vector<double> measured, predicted;
    };
    std::vector<Series> series;  ///< [meters]

    std::size_t n_days() const { return measured.rows; }
    /// Row of a day.
    std::size_t row_of(physics::Seconds time) const;
    physics::Seconds day_at(std::size_t row) const;
};

/// Simulates the building once, with every parameter at its nominal value. Meters read by
/// the month or bill have no columns.
DaySums day_sums(const study::Case& building);

}  // namespace bemcal::stock
