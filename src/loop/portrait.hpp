/// What a model leaves: where its residual points to, and how much of it could still be
/// foretold.
#pragma once

#include "loop/baseline.hpp"

#include <string>
#include <vector>

namespace bemcal::loop {

/// Hooks x drivers: the largest cumulated sum of a hook's score with the days ordered by
/// a driver (generalised M-fluctuation, Zeileis and Hornik 2007), over what noise exceeds
/// in one of a hundred cases. NaN where a hook cannot be moved.
struct Localisation {
    std::vector<std::string> hooks, drivers;
    Matrix statistic;
};
Localisation localise(const LoopData& data, const Place& place, const Standing& standing);

/// The largest of an effect's own cells: its score with the days ordered by what it
/// follows, by hour and by time. Before it joined it raised the alarm; after, an adequate
/// effect has brought it down.
double alarm_of(const LoopData& data, const Place& place, const Standing& standing,
                const effects::Effect& effect);

/// Whether an alarm that was `before` is over.
bool is_over(double before, double after);

/// Share of a channel's squared residual that means by hour of the week, then by month
/// and hour of the day, predict: in even blocks those of the odd ones, and the other way
/// round (LoopData::blocks); and the cell of month and hour where most of it lies.
struct Unexplained {
    double share = 0;
    std::string where;
};
std::vector<Unexplained> unexplained_of(const LoopData& data, const Standing& standing);

}  // namespace bemcal::loop
