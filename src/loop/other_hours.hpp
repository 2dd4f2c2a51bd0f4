/// Hours of plant and air flows that are not the declared ones, searched by simulation.
#pragma once

#include "loop/baseline.hpp"

#include <vector>

namespace bemcal::loop {

/// An effect of other hours than declared, and where the model goes with it.
struct Departure {
    effects::Effect effect;
    std::vector<double> x;  ///< unknowns of the model without it
    double price = 0;       ///< of evidence: runs that were tried for it
};

/// For each declared schedule of plant or air flows, that has one run a day and none of
/// the effects yet, the hours with which the model explains more than they cost; none
/// where that are the declared ones.
std::vector<Departure> other_hours(const LoopData& data, const Place& place,
                                   const Standing& standing);

}  // namespace bemcal::loop
