/// Steps of rows that lie in time: how far they are apart, where that changes, and rows
/// a little beside their step.
#pragma once

#include "physics/calendar.hpp"

#include <vector>

namespace bemcal::input {

/// A stamp may lie so much of its step beside it.
constexpr int part_of_step = 12;

/// The usual step that a distance is meant as: 3599 s are an hour. Distances beside all
/// of them, and above a day, stay. \return [s]
long long usual_step(long long distance_s);

struct RowSteps {
    int step_s = 0;          ///< the commonest; 0 = there are fewer than two rows
    std::vector<int> steps;  ///< [rows] where it changes; else empty
};
/// Another step counts where rows of two days or more follow each other by it.
/// \param at_end  a row's step ends, not begins, at its time
RowSteps row_steps(const std::vector<physics::Seconds>& times, bool at_end);

/// Seconds since the last whole step of the day; steps must divide a day.
long long phase_of(physics::Seconds time, long long step_s);

/// What rows have in common beside their steps.
struct Phase {
    long long offset_s = 0;    ///< after the whole step, of all rows [0, step)
    std::size_t n_moved = 0;   ///< rows beside that
    long long furthest_s = 0;  ///< of these
};
/// Moves rows [first, last) that lie within a twelfth of their step to the nearest one:
/// whole steps of the day, or those a fixed time after them. Rows beyond that stay.
Phase settle(std::vector<physics::Seconds>& times, std::size_t first, std::size_t last,
             long long step_s);

}  // namespace bemcal::input
