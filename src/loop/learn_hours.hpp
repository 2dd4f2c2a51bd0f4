/// Hours of schedules that nobody wrote down, learned from the readings by simulation.
#pragma once

#include "loop/baseline.hpp"
#include "physics/week_hours.hpp"

#include <array>
#include <string>
#include <vector>

namespace bemcal::loop {

/// A daily run, and how certain it is.
struct LearnedRun {
    physics::DailyRun run;
    double probability = 0;  ///< of this run among all
    /// What holds 90 % of the begins and of the ends, of runs that are not off.
    physics::DailyRun least, most;
};

struct LearnedHours {
    std::size_t profile = 0;  ///< of the case
    std::string name, use;
    physics::WeekHours usual;  ///< of its use, where the search began
    std::array<LearnedRun, physics::n_day_kinds> runs;
    double evidence = 0;  ///< of all hours learned over the usual ones of all

    physics::WeekHours hours() const;
};

/// Hours of all schedules of case.unknown_hours: start and end by kind of day, one after
/// the other, until none changes.
/// \param plain  calibrated with the usual hours
std::vector<LearnedHours> learn_hours(const LoopData& data, const Standing& plain);

/// The case with these hours in its schedules.
study::Case with_hours(const study::Case& building,
                       const std::vector<LearnedHours>& learned);

/// "schedule work: Monday to Friday 8 to 19 h, ...; learned, nobody declared it".
std::string sentence_of(const LearnedHours& learned);

}  // namespace bemcal::loop
