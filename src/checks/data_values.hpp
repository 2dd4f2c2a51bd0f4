/// Readings that are none by their value: codes for missing, spikes, use below zero, and
/// registers that count on where use is expected.
///
/// Each rule asks how far a value stands apart from all others, never how large it is:
/// true peaks come in company. A code is a known number, or one value again and again
/// far above the rest; a spike is an hour or two alone. Left out: codes that lie among
/// the readings, spikes below three times the highest other one.
#pragma once

#include "checks/data_readings.hpp"

namespace bemcal::checks {

struct Code {
    double value = 0;
    std::vector<int> at;  ///< where it stands
};

/// Codes that stand apart, by value. A known one that is read twice or more is half as
/// far away again as the readings reach, any other three times as far as they.
std::vector<Code> codes_in(const DataSeries& series);

/// One or two readings in a row far above all others (of a temperature: or below), in
/// the order of time.
std::vector<int> spikes_in(const DataSeries& series);

/// Readings below 0 of an energy.
struct Negatives {
    std::vector<int> offsets;  ///< within a hundredth of what the meter usually reaches
    std::vector<int> others;
    bool are_few = true;  ///< the others: a fault of single hours, no feed-in
};
Negatives negatives_in(const DataSeries& series);

/// How often readings rise and fall from one to the next that is known.
struct Course {
    int n_rises = 0, n_falls = 0;
    int n_restarts = 0;  ///< falls to near 0
};
Course course_of(std::span<const double> values);

/// Whether it is a register: it rises on, with next to no falls, or few where it starts
/// again, every day perhaps.
bool is_register(const Course& course);
/// The same of bills: nine rises and no fall.
bool is_register_of_bills(const Course& course);

/// What a register of instants counts until the next one [one less]; NaN beside a missing
/// reading and where it falls a little. Where it starts again near 0, what it shows since
/// then, and what was left to its full number if that is no more than steps count.
std::vector<double> differences_of(std::span<const double> counts);

}  // namespace bemcal::checks
