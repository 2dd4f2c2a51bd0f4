/// The totals that a building's model reaches over the ranges of its parameters, beside
/// what its meters show: a meter that lies outside fits no point, whatever is fitted.
#pragma once

#include "study/case.hpp"

#include <string>
#include <vector>

namespace bemcal::study {

/// A meter over a period; totals are of the intervals that have a reading [kWh].
struct MeterRange {
    std::size_t period = 0, meter = 0;  ///< of the case
    double measured = 0;
    double nominal = 0;          ///< of the building as described; NaN where it failed
    double least = 0, most = 0;  ///< of the points
    double n_points = 0;         ///< that could be simulated

    /// Whether a point comes as near as Guideline 14 lets a bias be.
    bool is_reached(double limit) const {
        return measured * (1 + limit) >= least && measured * (1 - limit) <= most;
    }
};

/// Of the meters of energy with a total above 0; of the named ones, all where none is
/// named. Left out are meters of which no point could be simulated, and those that show
/// next to nothing, as measured and at every point, beside the model's others.
/// Throws std::invalid_argument where a meter is read at another step than the
/// simulation's.
std::vector<MeterRange> ranges_of(const Case& building, std::size_t period,
                                  const std::vector<std::string>& meters);

}  // namespace bemcal::study
